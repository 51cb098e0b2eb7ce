/* SPDX-License-Identifier: MIT */
/* ticks_write.h - writes a tick as one line of ticks.jsonl. Each member of the line is a row of a table in
 * ticks_write.c. `octreel verify` and `octreel diff` compare the written lines, so a new member needs only a row. */
#ifndef FORMATS_TICKS_WRITE_H
#define FORMATS_TICKS_WRITE_H

#include "json_write.h"
#include "octree/game.h"

#include <stdio.h>

/* Facts of a line that are not part of the tick. */
typedef struct tick_extras {
    const char *frame;     /* file name of the frame; null for a tick without a frame */
    uint64_t scene_digest; /* digest of the frame's scene */
    bool whole;            /* list all nodes that split or merged, even more than TICK_LISTED */
} tick_extras;

/* If more nodes than this split (or merge) in a tick, the line has their count and a digest of their addresses instead
 * of a list; replaying the session gives the list. Earlier versions of Octreel listed all nodes. */
#define TICK_LISTED 256

/* Write a tick as one JSON object and a newline. The member "from" is written only if the collision test is swept: it
 * is the start of the sweep. A gap has only the members "tick" and "gap". The caller checks the stream for errors. */
void tick_write(FILE *out, const octree_tick *tick, const tick_extras *extras);

/* Read the digest of the scene at the end of a line, which ends with a newline. Returns false if the line does not name
 * a frame of this tick. */
bool tick_read_scene_digest(const char *line, size_t size, uint64_t tick, uint64_t *scene);

/* Write the parameters of an answer's query that the kind of the query has. */
void tick_write_query_parameters(json_writer *w, const octree_answer *answer);

/* Write an answer: an object with one member, named by the kind of the query. */
void tick_write_answer(json_writer *w, const octree_answer *answer);

/* Print a digest as sixteen hexadecimal digits. Returns `text`. */
#define DIGEST_TEXT 17
char *digest_print(uint64_t digest, char text[DIGEST_TEXT]);

#endif
