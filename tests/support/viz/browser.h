/* SPDX-License-Identifier: MIT */
/* browser.h - opens pages from the disk in headless Chromium, and runs scripts in them. */
#ifndef BROWSER_H
#define BROWSER_H

#include "temp_folder.h"

#include <stdbool.h>

bool is_browser_installed(void);

/* Skip the test with a note if there is no Chromium. */
void skip_without_browser(void);

/* Open a file as file://...#hash and return its HTML after five seconds of the page's virtual clock, which runs ahead
 * of real time. The browser stores its files in `own`. The caller frees the text. */
char *browser_open(const temp_folder *own, const char *path, const char *hash);

/* Open a copy of a page, in the same folder, with a script after the page's own scripts. The script acts like a user
 * and finally adds <pre id="said"> with a line "name<tab>value" for each observation. Returns these lines, after an
 * empty line; the caller frees them. The test fails if the script does not finish. */
char *browser_drive(const temp_folder *own, const char *page, const char *script);

/* browser_drive() with several scripts, run in order; the list ends with null. */
char *browser_drive_all(const temp_folder *own, const char *page, const char *const scripts[]);

/* The value that the script reported under a name; the caller frees it. The test fails if there is none. */
char *find_reported_value(const char *said, const char *what);
void assert_reported_value(const char *said, const char *what, const char *expected);

#endif
