/* SPDX-License-Identifier: MIT */
/* page.h - writes the page of a recording or session: one HTML file that shows the ticks in a browser and plays on. */
#ifndef RECORD_PAGE_H
#define RECORD_PAGE_H

#include "error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* The page has at most this many entries of each list of a tick, followed by {"more": the number left out}. */
#define PAGE_LIST 32

/* The largest session.json in bytes that is part of a page. For a larger one the page asks for the file. */
#define PAGE_MOST_SESSION ((size_t)128 << 20)

/* Whether pages contain the program as WebAssembly. Without it they only show frames. */
bool page_plays(void);

/* Write a page in this order: recording.json, each line of ticks.jsonl, session.json. `path` and `number`, a line, name
 * the text in errors. False with an error for text that is not JSON. Write errors stay with the stream. */
bool page_begin(FILE *page, const char *path, const char *recording, size_t size, octreel_error *error);
bool page_add_tick(FILE *page, const char *path, uintmax_t number, const char *line, size_t size, octreel_error *error);
void page_end(FILE *page, const char *session, size_t size);

/* Write index.html into a recording, from its other files; an incomplete last line of ticks.jsonl is ignored. Replaces
 * an existing index.html; a failure changes nothing. */
bool page_write(const char *folder, octreel_error *error);

#endif
