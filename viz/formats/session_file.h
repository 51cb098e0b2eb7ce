/* SPDX-License-Identifier: MIT */
/* session_file.h - sessions as files: a stream of JSON objects, the header and then objects of one tick each.
 * session.txt, which is installed, says what they hold.
 */
#ifndef FORMATS_SESSION_FILE_H
#define FORMATS_SESSION_FILE_H

#include "error.h"
#include "octree/game.h"
#include "point_values.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Ids and seeds in files are below this: every JSON reader keeps them exactly. */
#define SESSION_ID_LIMIT (UINT64_C(1) << 53)

/* The last tick that a file can name. */
#define SESSION_LAST_TICK 1000000000

/* The most points that "sample" makes. */
#define SESSION_MOST_SAMPLES 100000000

/* A session that owns its arrays and its keys. */
typedef struct session_file {
    octree_session session;
    point_values values; /* colours, intensities and classes, by the ids of the session's points */
    char note[512]; /* of one that was read: a sentence about its file of points; "" where there is nothing to say */
} session_file;

/* Read a session file, or "-", standard input, into *out; files of points are looked for in its folder. False with the
 * reason in *error; *out is then empty. Cost: O(size) in time; memory about ten times the size for points and never
 * beyond 100 times, plus what files of points and samples need. A file has at most 2 GiB. */
bool session_read(const char *path, session_file *out, octreel_error *error);

/* The same for text in memory. `name` is for errors; `folder` is where files of points are looked for, "" the current
 * one. Null: of a recording, which lists its points; other files and samples are refused, so that nothing but the text
 * is read, and decides about memory. */
bool session_parse(const char *name, const char *folder, const char *text, size_t size, session_file *out,
                   octreel_error *error);

/* Copy a session with all of its arrays; its points have no values. False when there is no memory or a key is unknown;
 * *out is then empty. */
bool session_copy(const octree_session *from, session_file *out, octreel_error *error);

/* Give the session a copy of these keys instead of its own. False when there is no memory or a key is unknown; the
 * session is then as it was. */
bool session_set_keys(session_file *file, const char *keys, octreel_error *error);

/* Free the arrays and empty the session; a zeroed one is allowed. */
void session_release(session_file *file);

/* Write the whole session inline, with the values of its points, which may be null, so that it plays anywhere: what is
 * read back is equal to the bit, and the same session makes the same bytes. The session must be one that a game
 * accepts, with ids below SESSION_ID_LIMIT, finite numbers and no tick beyond SESSION_LAST_TICK. The stream is flushed;
 * false on an I/O error. Cost: O(size). */
bool session_write(const octree_session *session, const point_values *values, FILE *out);

/* Copies that own their memory, to be released: the lists of ids of a query, and a program's tree. False where there is
 * no memory: what is there is then still to be released. */
bool query_copy_ids(octree_query *query);
void query_release_ids(octree_query *query);
bool foreign_tree_copy(const octree_foreign_tree *from, octree_foreign_tree *to);
void foreign_tree_release(octree_foreign_tree *tree);

/* The ticks of a session whose end is not known yet: its header says nothing of them. */
#define SESSION_ENDLESS UINT64_MAX

/* The parts of that, for a session that is being made: its header, and the object of one tick; nothing for a tick in
 * which nothing happens. Errors stay with the stream. */
void session_write_header(const octree_session *session, const point_values *values, FILE *out);
void session_write_tick(uint64_t tick, const octree_input *input, const point_values *values, FILE *out);

#endif
