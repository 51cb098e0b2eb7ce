/* SPDX-License-Identifier: MIT */
/* cause.h - two sessions played side by side: in what they differ, at which ticks, and how. */
#ifndef EXPLAIN_CAUSE_H
#define EXPLAIN_CAUSE_H

#include "cause_compare.h"
#include "trace.h"

/* A tick that is reported in detail. */
typedef struct cause_tick {
    uint64_t tick;
    cause_facts facts; /* none: nothing that happened differs */
    trace trace;       /* of its frames */
} cause_tick;

/* Ticks of one kind: how much there is in them, and the first and last of them. */
typedef struct cause_span {
    uint64_t count, first, last;
} cause_span;

/* How a program's wrong answers differ, of the ticks that both have. */
typedef struct cause_answers {
    cause_span more, fewer; /* wrong answers that the frames have in a tick beyond those of the reference; or lack */
    cause_span other;       /* ticks with as many, of other queries or by other faults */
} cause_answers;

/* A zeroed one is empty. */
typedef struct cause {
    cause_facts session; /* in what the sessions differ */
    cause_facts view;    /* in what their views differ; none when only sessions are compared */
    cause_tick *ticks;   /* reported in detail, in ascending order */
    size_t count, room;
    cause_answers wrong;
    uint64_t compared;    /* ticks that both have */
    uint64_t differing;   /* of them, in what happened */
    uint64_t first, last; /* of those that differ */
    uint64_t drawn;       /* the first tick whose frames differ; CAUSE_NO_TICK: none, or there are no frames */
} cause;

/* Callbacks while two sessions are played. */
typedef struct cause_watcher {
    size_t first; /* how many of the first differing ticks are reported in detail */

    /* Whether another tick is reported in detail; may be null. */
    bool (*wants)(void *context, uint64_t tick);

    /* Called at each tick that both have, with the games at it, and whether what happened differs. False with an
     * error ends the playing. May be null. */
    bool (*watch)(void *context, const octree_game *const games[2], bool differs, octreel_error *error);
    void *context;
} cause_watcher;

/* Compare two sessions and play them side by side. `views`, which may be null, add what shows in pictures alone. False
 * with an error when one cannot be played; *c is to be released in any case. */
bool cause_find(const session_file *a, const session_file *b, const cause_view views[2], const cause_watcher *watcher,
                cause *c, octreel_error *error);
void cause_release(cause *c);

/* A tick that is reported in detail, or null. */
const cause_tick *cause_at(const cause *c, uint64_t tick);

#endif
