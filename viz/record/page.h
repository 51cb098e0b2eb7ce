/* SPDX-License-Identifier: MIT */
/* page.h - a session as a page to scrub through and to play on, which opens from the disk: index.html of a recording,
 * or a file of its own. */
#ifndef RECORD_PAGE_H
#define RECORD_PAGE_H

#include "error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Of a longer list of a tick the page has the first entries, followed by {"more": how many are left out}. */
#define PAGE_LIST 32

/* A larger session.json is left out of the page, in bytes: the page then asks for the file. */
#define PAGE_MOST_SESSION ((size_t)128 << 20)

/* Whether pages hold the program, as WebAssembly: else they show frames alone. */
bool page_plays(void);

/* A page as it is written: recording.json, each line of ticks.jsonl, and session.json. `path` and `number` are for
 * errors: which text is no JSON, and in which line. Errors of writing stay with the stream. */
bool page_begin(FILE *page, const char *path, const char *recording, size_t size, octreel_error *error);
bool page_add(FILE *page, const char *path, uintmax_t number, const char *line, size_t size, octreel_error *error);
void page_end(FILE *page, const char *session, size_t size);

/* Write index.html into a recording, from its files and the whole lines of its ticks.jsonl as they are there. What was
 * there of that name is replaced; on failure nothing changes. */
bool page_write(const char *folder, octreel_error *error);

#endif
