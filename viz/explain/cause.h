/* SPDX-License-Identifier: MIT */
/* cause.h - plays two sessions side by side, and finds the differences between them and the ticks in which they
 * differ. */
#ifndef EXPLAIN_CAUSE_H
#define EXPLAIN_CAUSE_H

#include "cause_compare.h"
#include "trace.h"

/* A tick that is reported in detail. */
typedef struct cause_tick {
    uint64_t tick;
    cause_facts facts; /* the differences between the sessions at this tick; empty if there are none */
    trace trace;       /* the elements drawn at the pixels that differ between the tick's frames */
} cause_tick;

/* A count of ticks or answers that differ, and the first and the last tick in which they occur. */
typedef struct cause_span {
    uint64_t count, first, last;
} cause_span;

/* How the wrong answers of a foreign index differ at a tick: the compared recording has more wrong answers than the
 * reference, fewer, or the same number but different ones. For WRONG_MORE and WRONG_FEWER the number of answers is
 * counted; for WRONG_OTHER the number of ticks. */
typedef enum cause_wrong { WRONG_MORE, WRONG_FEWER, WRONG_OTHER, WRONG_CHANGES } cause_wrong;

/* The differences between two sessions. A zeroed cause has none. */
typedef struct cause {
    cause_facts session; /* the differences between the sessions */
    cause_facts view;    /* the differences between the views; empty if only sessions were compared */
    cause_tick *ticks;   /* the ticks that are reported in detail, in ascending order */
    size_t count, room;
    cause_span wrong[WRONG_CHANGES];
    uint64_t compared;    /* the number of ticks that both sessions have */
    cause_span differing; /* the span of the ticks that both sessions have and that differ between them */
    uint64_t drawn;       /* the first tick whose frames differ; CAUSE_NO_TICK if no frames differ */
} cause;

/* Settings and callbacks of cause_find(). */
typedef struct cause_watcher {
    size_t first; /* this number of differing ticks, beginning with the first differing tick, is reported in detail */

    /* Returns whether a tick is reported in detail although it is not among the `first` ticks. May be null. */
    bool (*wants)(void *context, uint64_t tick);

    /* Called at each tick that both sessions have. `differs` is true if the tick differs between the sessions. To
     * stop the comparison, the callback returns false with an error. May be null. */
    bool (*watch)(void *context, const octree_game *const games[2], bool differs, octreel_error *error);
    void *context;
} cause_watcher;

/* Play two sessions side by side and compare them. If `views` is not null, also compare the views with which the
 * sessions are drawn. Return false with an error if a session cannot be played. The caller releases *c in any case. */
bool cause_find(const session_file *a, const session_file *b, const cause_view views[2], const cause_watcher *watcher,
                cause *c, octreel_error *error);
void cause_release(cause *c);

/* Return the details of a tick, or null if the tick is not reported in detail. */
const cause_tick *cause_find_tick(const cause *c, uint64_t tick);

#endif
