/* SPDX-License-Identifier: MIT */
/* browser.h - headless Chromium: what becomes of a page that is opened from the disk. */
#ifndef BROWSER_H
#define BROWSER_H

#include "temp_folder.h"

#include <stdbool.h>

bool browser_is_there(void);

/* Skip the test, and say so, where there is no Chromium. */
void need_browser(void);

/* Open a file as file://...#hash and return its elements as they are five seconds later, by the page's own clock, which
 * does not wait. `own` takes the browser's files. The caller frees it. */
char *browser_open(const temp_folder *own, const char *path, const char *hash);

/* Open a copy of a page, beside it, with a script behind all of its own, which uses it as people do and ends by adding
 * <pre id="said"> with a line "what<tab>value" for each thing that it saw. Returns these lines, an empty one before
 * them; the caller frees it. The test fails when the script does not come to its end. */
char *browser_drive(const temp_folder *own, const char *page, const char *script);

/* The same with several scripts, one behind the other; a null ends them. */
char *browser_drive_all(const temp_folder *own, const char *page, const char *const scripts[]);

/* What was said about something; the caller frees it. The test fails when nothing was. */
char *said_about(const char *said, const char *what);
void assert_said_about(const char *said, const char *what, const char *expected);

#endif
