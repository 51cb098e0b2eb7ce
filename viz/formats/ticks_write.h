/* SPDX-License-Identifier: MIT */
/* ticks_write.h - writes a tick as one line of ticks.jsonl. Each member of the line is a row of a table in
 * ticks_write.c. `octreel verify` and `octreel diff` compare lines as text, so a new member needs a new row and no
 * other change. */
#ifndef FORMATS_TICKS_WRITE_H
#define FORMATS_TICKS_WRITE_H

#include "json_write.h"
#include "octree/game.h"

#include <stdio.h>

/* The values of a line of ticks.jsonl that do not follow from the tick. */
typedef struct tick_extras {
    const char *frame;     /* the file name of the tick's frame; null: the tick has no frame */
    uint64_t scene_digest; /* the digest of the frame's scene */
    bool whole;            /* true: list all nodes that split or merged, even more than TICK_LISTED */
} tick_extras;

/* If more than this number of nodes split (or merge) in a tick, the line has no list of these nodes, but their count
 * and a digest of their addresses. Replaying the session gives the list. Earlier versions of Octreel always listed the
 * nodes. */
#define TICK_LISTED 256

/* Writes a tick as one JSON object and a newline. The member "from", the start of a sweep, is written only if the
 * collision test is swept. The line of a gap has only the members "tick" and "gap". The caller checks the stream for
 * errors. */
void tick_write(FILE *out, const octree_tick *tick, const tick_extras *extras);

/* Reads the digest of the scene from the end of a line of ticks.jsonl. The line ends with a newline. Returns false if
 * the line does not name the frame of `tick`. */
bool tick_read_scene_digest(const char *line, size_t size, uint64_t tick, uint64_t *scene);

/* Writes the parameters of an answer's query: only the parameters that queries of this kind have. */
void tick_write_query_parameters(json_writer *w, const octree_answer *answer);

/* Writes an answer as an object with one member. The name of the member is the kind of the answer's query. */
void tick_write_answer(json_writer *w, const octree_answer *answer);

/* Writes the member "foreign_pairs" of a tick. w->context is a tick_extras. */
void tick_write_foreign_pairs(json_writer *w, const octree_pair_judgement *pairs);

/* Prints a digest as sixteen hexadecimal digits. Returns `text`. */
#define DIGEST_TEXT 17
char *digest_print(uint64_t digest, char text[DIGEST_TEXT]);

#endif
