/* SPDX-License-Identifier: MIT */
/* browser.h - opens pages from the disk in headless Chromium, and runs scripts in them. */
#ifndef BROWSER_H
#define BROWSER_H

#include "temp_folder.h"

#include <stdbool.h>

bool browser_is_there(void);

/* Skip the test with a note if there is no Chromium. */
void need_browser(void);

/* Open a file as file://...#hash and return its HTML after five seconds of the page's virtual clock, which runs ahead
 * of real time. The browser stores its files in `own`. The caller frees the text. */
char *browser_open(const temp_folder *own, const char *path, const char *hash);

/* Open a copy of a page, beside it, with a script behind all of its own, which uses it as people do and ends by adding
 * <pre id="said"> with a line "what<tab>value" for each thing that it saw. Returns these lines, an empty one before
 * them; the caller frees it. The test fails when the script does not come to its end. */
char *browser_drive(const temp_folder *own, const char *page, const char *script);

/* browser_drive() with several scripts, run in order; the list ends with null. */
char *browser_drive_all(const temp_folder *own, const char *page, const char *const scripts[]);

/* The value that the script reported under a name; the caller frees it. The test fails if there is none. */
char *said_about(const char *said, const char *what);
void assert_said_about(const char *said, const char *what, const char *expected);

#endif
