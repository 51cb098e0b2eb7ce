/* SPDX-License-Identifier: MIT */
/* page.h - writes the page of a recording or session: one HTML file that shows the ticks in a browser and can continue
 * the game. */
#ifndef RECORD_PAGE_H
#define RECORD_PAGE_H

#include "error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* The maximum number of entries that the page has of each list of a tick. {"more": N} follows if N entries were left
 * out. */
#define PAGE_LIST 32

/* The maximum size in bytes of a session.json that is embedded in a page. For a larger session the page asks the reader
 * for the file. */
#define PAGE_MOST_SESSION ((size_t)128 << 20)

/* Returns true if pages contain the program as WebAssembly. If not, pages only show frames. */
bool page_plays(void);

/* Write a page. Call page_begin() with the text of recording.json, then page_add_tick() for each line of ticks.jsonl,
 * then page_end() with the text of session.json. In error messages `path` and the line number `number` are the source
 * of the text. Returns false with an error if the text is not JSON. Write errors are left to the caller, who checks the
 * stream. */
bool page_begin(FILE *page, const char *path, const char *recording, size_t size, octreel_error *error);
bool page_add_tick(FILE *page, const char *path, uintmax_t number, const char *line, size_t size, octreel_error *error);
void page_end(FILE *page, const char *session, size_t size);

/* Write index.html into a recording, from the other files in its folder. An incomplete last line of ticks.jsonl is
 * ignored. An existing index.html is replaced, but stays as it is if this fails. */
bool page_write(const char *folder, octreel_error *error);

#endif
