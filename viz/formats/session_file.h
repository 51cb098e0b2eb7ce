/* SPDX-License-Identifier: MIT */
/* session_file.h - reads and writes session files. A file is a stream of JSON objects: a header, then one object for
 * each tick in which something happens. session.txt, which is installed, describes the format. */
#ifndef FORMATS_SESSION_FILE_H
#define FORMATS_SESSION_FILE_H

#include "error.h"
#include "octree/game.h"
#include "point_values.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Ids and seeds in files are below this limit: every JSON reader reads such numbers exactly. */
#define SESSION_ID_LIMIT (UINT64_C(1) << 53)

/* The greatest number of a tick in a file. */
#define SESSION_LAST_TICK 1000000000

/* The most points that "sample" can generate. */
#define SESSION_MOST_SAMPLES 100000000

/* A session that owns its arrays and its keys. */
typedef struct session_file {
    octree_session session;
    point_values values; /* colours, intensities and classes, by the ids of the session's points */
    char note[512]; /* after reading: a sentence about the session's file of points; "" if there is nothing to report */
} session_file;

/* Read a session file, or standard input if the path is "-", into *out. Relative paths of files of points start at the
 * folder of the session file. False with the reason in *error; *out is then empty. A file has at most 2 GiB.
 * Cost: O(size) time. Memory: about ten times the size of the file for points, at most 100 times for anything, plus the
 * memory for files of points and samples. */
bool session_read(const char *path, session_file *out, octreel_error *error);

/* Parse a session in memory. Errors call the text `name`. Relative paths of files of points start at `folder`, "" for
 * the current folder. `folder` is null for the session.json of a recording, which lists its points: files of points and
 * samples are then refused, so that an untrusted text can neither read other files nor claim much memory. */
bool session_parse(const char *name, const char *folder, const char *text, size_t size, session_file *out,
                   octreel_error *error);

/* Copy a session with all its arrays, but without values of points. Returns false, and empties *out, if memory runs out
 * or a key is unknown. */
bool session_copy(const octree_session *from, session_file *out, octreel_error *error);

/* Replace the keys of the session by a copy of `keys`. Returns false, and changes nothing, if memory runs out or a key
 * is unknown. */
bool session_set_keys(session_file *file, const char *keys, octreel_error *error);

/* Free the arrays and zero the structure; a zeroed structure is allowed. */
void session_release(session_file *file);

/* Write the whole session with all its points, so that the file needs no other file. `values` are the values of the
 * points; null for none. Reading the file restores every number to the bit, and equal sessions yield equal bytes. A
 * game must accept the session; ids must be below SESSION_ID_LIMIT, numbers finite, and ticks at most
 * SESSION_LAST_TICK. The stream is flushed. False on an I/O error. Cost: O(size). */
bool session_write(const octree_session *session, const point_values *values, FILE *out);

/* Replace the lists of ids of a query, or the nodes of a foreign tree, by copies that the caller releases. If memory
 * runs out, returns false; the caller must then also release them. */
bool query_duplicate_ids(octree_query *query);
void query_release_ids(octree_query *query);
bool foreign_tree_duplicate(const octree_foreign_tree *from, octree_foreign_tree *to);
void foreign_tree_release(octree_foreign_tree *tree);

/* The number of ticks of a session without a known end; its header is written without "ticks". */
#define SESSION_ENDLESS UINT64_MAX

/* Write the header of a session, then the object of each tick, while the session is being made. Nothing is written for
 * a tick without input. The caller checks the stream for errors. */
void session_write_header(const octree_session *session, const point_values *values, FILE *out);
void session_write_tick(uint64_t tick, const octree_input *input, const point_values *values, FILE *out);

#endif
