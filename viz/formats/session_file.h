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

/* Ids and seeds in files are below this limit, because every JSON reader reads such numbers exactly. */
#define SESSION_ID_LIMIT (UINT64_C(1) << 53)

/* The largest number of a tick in a file. */
#define SESSION_LAST_TICK 1000000000

/* The largest number of ticks that are played unless the caller allows more. A session of 50 bytes could otherwise keep
 * a machine busy for hours. */
#define SESSION_MOST_PLAYED 10000000

/* The largest number of points that "sample" can generate. */
#define SESSION_MOST_SAMPLES 100000000

/* A session that owns its arrays and keys. */
typedef struct session_file {
    octree_session session;
    point_values values; /* colours, intensities and classes of points, found by the points' ids */
    char note[672]; /* set by reading: a sentence about the session's point file; "" if there is nothing to report */
} session_file;

/* Reads a session file into *out. The path "-" reads standard input. Relative paths of point files start at the
 * folder of the session file. On failure returns false with the reason in *error, and *out is empty. A session file
 * has at most 2 GiB. Cost: O(size) time. Memory: about ten times the size of a file that lists points, and at most
 * 100 times the size of any file; in addition the memory for point files and samples. */
bool session_read(const char *path, session_file *out, octreel_error *error);

/* Parses a session in memory. Errors use `name` as its file name. Relative paths of point files start at `folder`;
 * "" is the current folder. `folder` is null for the session.json of a recording, which lists all its points. Point
 * files and samples are then refused, so that an untrusted text can neither read other files nor claim much memory. */
bool session_parse(const char *name, const char *folder, const char *text, size_t size, session_file *out,
                   octreel_error *error);

/* Copies a session with all its arrays, but without the values of its points. If memory runs out or a key is
 * unknown, empties *out and returns false. */
bool session_copy(const octree_session *from, session_file *out, octreel_error *error);

/* Replaces the session's keys by a copy of `keys`. If memory runs out or a key is unknown, changes nothing and
 * returns false. */
bool session_set_keys(session_file *file, const char *keys, octreel_error *error);

/* Checks that a session has at most `most` ticks after tick 0, or SESSION_MOST_PLAYED if `most` is 0. Otherwise returns
 * false with an error that names --max-ticks. */
bool session_check_length(const octree_session *session, uint64_t most, octreel_error *error);

/* Frees the arrays of a session and zeroes the structure. The structure may be zeroed already. */
void session_release(session_file *file);

/* Writes the whole session with all its points, so that the file needs no other file. `values` are the values of the
 * points; null: no point has values. Reading the file restores every number exactly. Equal sessions give equal
 * bytes. The session must be valid for octree_game_create(); ids must be below SESSION_ID_LIMIT, numbers finite, and
 * ticks at most SESSION_LAST_TICK. The stream is flushed. Returns false on an I/O error. Cost: O(size). */
bool session_write(const octree_session *session, const point_values *values, FILE *out);

/* Replace the lists of ids of a query, or the nodes of a foreign tree, by copies. The caller releases the copies,
 * even if memory runs out and the function returns false. */
bool query_duplicate_ids(octree_query *query);
void query_release_ids(octree_query *query);
bool foreign_tree_duplicate(const octree_foreign_tree *from, octree_foreign_tree *to);
void foreign_tree_release(octree_foreign_tree *tree);

/* The number of ticks of a session whose end is unknown. Its header is written without "ticks". */
#define SESSION_ENDLESS UINT64_MAX

/* Write a session while it is being made: first the header, then the object of each tick. For a tick without input,
 * nothing is written. The caller checks the stream for errors. */
void session_write_header(const octree_session *session, const point_values *values, FILE *out);
void session_write_tick(uint64_t tick, const octree_input *input, const point_values *values, FILE *out);

#endif
