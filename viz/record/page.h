/* SPDX-License-Identifier: MIT */
/* page.h - index.html: a recording as a page to scrub through, which opens from the disk. */
#ifndef RECORD_PAGE_H
#define RECORD_PAGE_H

#include "error.h"

/* Of a longer list of a tick the page has the first entries, followed by {"more": how many are left out}. */
#define PAGE_LIST 32

/* Write index.html into a recording, from its recording.json and the whole lines of its ticks.jsonl as they are there.
 * What was there of that name is replaced; on failure nothing changes. */
bool page_write(const char *folder, octreel_error *error);

#endif
