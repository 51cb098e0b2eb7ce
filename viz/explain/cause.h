/* SPDX-License-Identifier: MIT */
/* cause.h - plays two sessions side by side and finds what differs between them, and in which ticks. */
#ifndef EXPLAIN_CAUSE_H
#define EXPLAIN_CAUSE_H

#include "cause_compare.h"
#include "trace.h"

/* A tick that is reported in detail. */
typedef struct cause_tick {
    uint64_t tick;
    cause_facts facts; /* empty: the same happened in both sessions */
    trace trace;       /* the elements at the pixels in which the tick's frames differ */
} cause_tick;

/* A count over the ticks in which something occurs, with the first and the last of these ticks. */
typedef struct cause_span {
    uint64_t count, first, last;
} cause_span;

/* How the wrong answers of a foreign index differ at a tick: the frames have more or fewer than the reference, or as
 * many but other ones. The first two count answers, the last one counts ticks. */
typedef enum cause_wrong { WRONG_MORE, WRONG_FEWER, WRONG_OTHER, WRONG_CHANGES } cause_wrong;

/* Zeroed: empty. */
typedef struct cause {
    cause_facts session; /* the differences between the sessions */
    cause_facts view;    /* the differences between the views; empty if only sessions are compared */
    cause_tick *ticks;   /* reported in detail, in ascending order */
    size_t count, room;
    cause_span wrong[WRONG_CHANGES];
    uint64_t compared;    /* the number of ticks that both sessions have */
    cause_span differing; /* these ticks in which something different happens */
    uint64_t drawn;       /* the first tick whose frames differ; CAUSE_NO_TICK if there is none */
} cause;

/* Callbacks while two sessions are played. */
typedef struct cause_watcher {
    size_t first; /* the number of differing ticks, from the first on, that are reported in detail */

    /* Whether a further tick is reported in detail; may be null. */
    bool (*wants)(void *context, uint64_t tick);

    /* Called at each tick that both sessions have. `differs`: different things happen in it. To stop, return false with
     * an error. May be null. */
    bool (*watch)(void *context, const octree_game *const games[2], bool differs, octreel_error *error);
    void *context;
} cause_watcher;

/* Compare two sessions and play them side by side. `views`, which may be null, adds the differences that only pictures
 * show. Return false with an error if a session cannot be played. Release *c in any case. */
bool cause_find(const session_file *a, const session_file *b, const cause_view views[2], const cause_watcher *watcher,
                cause *c, octreel_error *error);
void cause_release(cause *c);

/* The details of a tick, or null if it is not reported in detail. */
const cause_tick *cause_find_tick(const cause *c, uint64_t tick);

#endif
