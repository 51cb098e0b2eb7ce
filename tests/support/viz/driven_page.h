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
void skip_without_playing_page(const char *page);

/* Play a page with the scripts of these names in tests/support/viz, or of whole paths, after drive.js; the list ends
 * with null. Returns the reported lines; null if there is no browser or the page has no WebAssembly module. */
char *run_scripts_in_playing_page(const temp_folder *own, const char *page, const char *const scripts[]);

/* run_scripts_in_playing_page() for any page; null if there is no browser. */
char *run_scripts_in_page(const temp_folder *own, const char *page, const char *const scripts[]);

/* Write a script that defines `given` for the other scripts. The texts in it must not contain '<'. */
place write_given_script(const temp_folder *own, const json_t *given);

/* The digest of a PNG's colours, four bytes per pixel, as drive.js computes it. */
uint32_t compute_png_digest(const char *path);

/* The test fails unless the values reported for "<name> <tick>" equal the facts, scenes and frames of the recording in
 * the folder, for all of its `count` ticks. With `some`, values of ticks may be missing. */
void assert_reported_ticks(const char *said, const char *name, const char *folder, size_t count, bool some);

/* The test fails unless a JSON text equals the output of `octreel pick` for a pixel, except the name of the file, which
 * a page does not have. */
void assert_reported_pick(const char *said, const char *frame, int x, int y, int radius);

#endif
