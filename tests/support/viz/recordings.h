/* SPDX-License-Identifier: MIT */
/* recordings.h - films small recordings for tests, and inspects them. */
#ifndef RECORDINGS_H
#define RECORDINGS_H

#include "files.h"
#include "film.h"
#include "image.h"

/* The frame size of most recordings in tests. */
#define SMALL_WIDTH 160
#define SMALL_HEIGHT 90

/* Options for small frames of every tick with all layers, in this folder. */
film_options small_film(const char *folder);

/* The default session with these keys alone. */
octree_session short_session(const char *keys);

/* The same options for the ticks [first, last). */
film_options chunk_of(film_options options, uint64_t first, uint64_t last);

/* Options that stop filming after `*ticks` ticks; *ticks is counted down. */
film_options stopped_after(film_options options, uint64_t *ticks);

/* The path of a frame. */
place frame_place(const char *folder, uint64_t tick);

/* Film a session; the test fails with the error if that fails. */
film_summary assert_filmed(const octree_session *session, const film_options *options);

/* A frame, decoded: the test fails unless it is whole, 8-bit indexed, of this size and of the theme's table. */
image assert_whole_frame(const char *path, int width, int height);

/* The test fails unless an interrupted run left only: complete frames of the small size, complete lines in ticks.jsonl
 * except the last one, complete JSON in the other files, and no .part file. */
void assert_nothing_half_written(const char *folder);

/* Call visit() for each line of ticks.jsonl, zero-terminated and without its newline; `visit` may be null. Returns the
 * number of lines. */
size_t for_each_line(const char *folder, void (*visit)(const char *line, size_t number, void *context), void *context);

/* Call note() for each line of ticks.jsonl; it appends to a text of up to 63 characters, its context. The test fails
 * unless the text is as expected. */
void assert_noted_lines(const char *folder, void (*note)(const char *line, size_t number, void *text),
                        const char *expected);

#endif
