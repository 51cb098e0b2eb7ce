/* SPDX-License-Identifier: MIT */
/* driven_page.h - runs scripts in a page, drive.js first, and compares what they report with the program octreel. */
#ifndef DRIVEN_PAGE_H
#define DRIVEN_PAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <jansson.h>

#include "files.h"

/* Whether a page contains the WebAssembly module. */
bool page_has_module(const char *page);

/* Skip the test with a note if there is no browser, or the page has no WebAssembly module. */
void need_playing_page(const char *page);

/* Play a page by the scripts of tests/support/viz with these names, or by whole paths, behind drive.js; a null ends
 * them. The lines that were said, or null where there is no browser or the page does not play. */
char *play_page(const temp_folder *own, const char *page, const char *const scripts[]);

/* play_page() for any page; null if there is no browser. */
char *drive_page_by(const temp_folder *own, const char *page, const char *const scripts[]);

/* A script for them that defines `given`, in whose texts no '<' is. */
place write_given(const temp_folder *own, const json_t *given);

/* The digest of a PNG's colours, four bytes per pixel, as drive.js computes it. */
uint32_t digest_of_png(const char *path);

/* What was said of "<name> <tick>" is what the recording in the folder has of all its ticks, which are `count`: facts,
 * scenes and frames. `some`: not each was said. */
void assert_ticks_said(const char *said, const char *name, const char *folder, size_t count, bool some);

/* A text of JSON is what pick says of a pixel, all but the name of the file, which a page does not have. */
void assert_pick_said(const char *said, const char *frame, int x, int y, int radius);

#endif
