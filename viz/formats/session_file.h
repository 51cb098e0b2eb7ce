/* SPDX-License-Identifier: MIT */
/* session_file.h - reads and writes session files. A session file is a stream of JSON objects: a header, then one
 * object for each tick that has input. session.txt, which is installed, describes the format. */
#ifndef FORMATS_SESSION_FILE_H
#define FORMATS_SESSION_FILE_H

#include "error.h"
#include "octree/game.h"
#include "point_values.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* The exclusive upper bound of ids and seeds in files. Every JSON reader reads integers below this bound exactly. */
#define SESSION_ID_LIMIT (UINT64_C(1) << 53)

/* The largest number that a tick may have in a file. */
#define SESSION_LAST_TICK 1000000000

/* The largest number of ticks that are played unless the caller sets another limit. Without a limit, a session file
 * of 50 bytes could keep a machine busy for hours. */
#define SESSION_MOST_PLAYED 10000000

/* The largest number of points that "sample" can generate. */
#define SESSION_MOST_SAMPLES 100000000

/* A session that owns its arrays and keys. */
typedef struct session_file {
    octree_session session;
    point_values values; /* colours, intensities and classes of points, found by the points' ids */
    /* set when a session is read: a sentence about how its point file was read; "" if there is nothing to report */
    char note[672];
} session_file;

/* Reads a session file into *out. The path "-" is standard input. Relative paths of point files start at the folder
 * of the session file. On failure returns false with the reason in *error, and *out is empty. A session file has at
 * most 2 GiB. Cost: O(size) time. Memory: about ten times the file's size for a file that lists points; at most 100
 * times for any file. Point files and samples need more memory. */
bool session_read(const char *path, session_file *out, octreel_error *error);

/* Parses a session in memory. Errors use `name` as the name of its file. `folder` is the folder at which relative
 * paths of point files start; "" is the current folder. `folder` is null for the session.json of a recording, which
 * lists all its points. Then point files and samples are refused, so that an untrusted text can neither read other
 * files nor allocate much memory. */
bool session_parse(const char *name, const char *folder, const char *text, size_t size, session_file *out,
                   octreel_error *error);

/* Copies a session with all its arrays. The values of points (colours, intensities and classes) are not copied. If
 * memory runs out or a key is unknown, empties *out and returns false with an error. */
bool session_copy(const octree_session *from, session_file *out, octreel_error *error);

/* Replaces the session's keys (the key presses of its player) by a copy of `keys`. If memory runs out or a key is
 * unknown, changes nothing and returns false with an error. */
bool session_set_keys(session_file *file, const char *keys, octreel_error *error);

/* Checks that a session has at most `most` ticks after tick 0, or SESSION_MOST_PLAYED if `most` is 0. Otherwise returns
 * false with an error that names --max-ticks. */
bool session_check_length(const octree_session *session, uint64_t most, octreel_error *error);

/* Frees the arrays of a session and zeroes the structure. The structure may be zeroed already. */
void session_release(session_file *file);

/* Writes a whole session with all its points, so that the file needs no other file. `values` are the colours,
 * intensities and classes of the points, or null. Reading the file restores every number exactly. Equal sessions
 * give equal bytes. The session must be valid for octree_game_create(); ids must be below SESSION_ID_LIMIT, numbers
 * finite, and ticks at most SESSION_LAST_TICK. The function flushes the stream. Returns false on an I/O error. Cost:
 * O(size). */
bool session_write(const octree_session *session, const point_values *values, FILE *out);

/* query_copy_ids() replaces the lists of ids of a query by copies. foreign_tree_duplicate() and
 * foreign_pairs_duplicate() write a copy of *from to *to, which may be the same structure. All three return false if
 * memory runs out. The caller releases the copies in any case. */
bool query_copy_ids(octree_query *query);
void query_release_ids(octree_query *query);
bool foreign_tree_duplicate(const octree_foreign_tree *from, octree_foreign_tree *to);
void foreign_tree_release(octree_foreign_tree *tree);
bool foreign_pairs_duplicate(const octree_foreign_pairs *from, octree_foreign_pairs *to);
void foreign_pairs_release(octree_foreign_pairs *pairs);

/* The value of a session's `ticks` while the number of its ticks is unknown. The header of such a session is written
 * without the member "ticks". */
#define SESSION_ENDLESS UINT64_MAX

/* Write a session while the session is being made: first the header, then one object for each tick. A tick without
 * input has no object, so nothing is written for it. The caller checks the stream for errors. */
void session_write_header(const octree_session *session, const point_values *values, FILE *out);
void session_write_tick(uint64_t tick, const octree_input *input, const point_values *values, FILE *out);

#endif
