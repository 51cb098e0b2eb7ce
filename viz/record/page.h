/* viewer.h - index.html: a recording as a page to scrub through, which opens from the disk. */
#ifndef RECORD_VIEWER_H
#define RECORD_VIEWER_H

#include "folder.h"

/* A list of a tick that has more entries is cut off in the page, which says so. */
#define VIEWER_LIST 32

/* Write index.html into a recording, from its recording.json and the whole lines of its ticks.jsonl as they are there.
 * What was there of that name is replaced; on failure nothing changes. */
bool viewer_write(const char *folder, octreel_error *error);

#endif
