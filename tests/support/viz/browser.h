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

#endif
