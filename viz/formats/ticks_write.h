/* SPDX-License-Identifier: MIT */
/* ticks_write.h - a tick as one line of ticks.jsonl. Each fact is a row of line_members in ticks_write.c, and by what
 * is written ticks are verified and compared: a new one needs nothing else. */
#ifndef FORMATS_TICKS_WRITE_H
#define FORMATS_TICKS_WRITE_H

#include "json_write.h"
#include "octree/game.h"

#include <stdio.h>

/* What a line says beyond the tick itself. */
typedef struct tick_extras {
    const char *frame;     /* the file's name, or null for a tick that was not filmed */
    uint64_t scene_digest; /* of that frame */
    bool whole;            /* nodes that split or merged are listed, however many there are */
} tick_extras;

/* Where more nodes than these split at a tick, or merge, their line has how many there are, and a digest of their
 * addresses: who wants them plays the session again. Earlier versions listed them all. */
#define TICK_LISTED 256

/* One JSON object and a newline. Where the collision test is swept it begins at "from", else there is none. Of a gap it
 * says the tick and why, and nothing else. Errors stay with the stream. */
void tick_write(FILE *out, const octree_tick *tick, const tick_extras *extras);

/* Write the members of a query that its kind reads, from its answer. */
void tick_write_asked(json_writer *w, const octree_answer *answer);

/* An answer as a line has it: an object with one member, by the name of its kind. */
void tick_write_answer(json_writer *w, const octree_answer *answer);

/* A digest as files have it: sixteen hexadecimal digits. Returns `text`. */
#define DIGEST_TEXT 17
char *digest_print(uint64_t digest, char text[DIGEST_TEXT]);

#endif
