/* SPDX-License-Identifier: MIT */
/* cause_origins.h - finds which differences between two sessions are responsible for each tick, so that frames with the
 * same cause form one group in a report.
 *
 * The problem: one different key changes hundreds of frames. They should be reported as one finding, but apart from the
 * frames that a different query at a later tick changes. Frames cannot be grouped by what they show, since each tick
 * shows something else.
 *
 * The idea: while both sessions are played, keep for each kind of difference the tick since which it is in effect. A
 * different key or edit takes effect at its tick and stays in effect while the states of the two games differ. A
 * different query or shape affects its own tick only; if the view shows heat, it affects all later ticks, too. Whenever
 * the set changes, a new stretch of ticks begins. The text of the set ("keys 14, queries radius 15") is the key of the
 * group of every frame in that stretch. Cost: one binary search for each frame.
 */
#ifndef EXPLAIN_CAUSE_ORIGINS_H
#define EXPLAIN_CAUSE_ORIGINS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A kind of difference: "keys", "edits", "queries radius". */
#define CAUSE_KIND 64
typedef struct cause_kind {
    char name[CAUSE_KIND];
    uint64_t since; /* the tick since which it is in effect; CAUSE_NO_TICK if it is not; changes while games play */
} cause_kind;

typedef struct cause_origin {
    uint64_t tick;
    size_t kind;
} cause_origin;

/* A run of ticks with the same causes; it ends where the next stretch begins. */
typedef struct cause_stretch {
    uint64_t first;
    char *causes; /* "keys 14, queries radius 15": each kind in effect and its first tick; null for none; owned */
} cause_stretch;

/* Zeroed: empty. */
typedef struct cause_origins {
    cause_kind *kinds;
    size_t kind_count, kind_room;
    cause_origin *listed; /* in ascending order of ticks when they are sorted */
    size_t count, room, next;
    cause_stretch *stretches;
    size_t stretch_count, stretch_room;
} cause_origins;

/* Add a difference at a tick. `where` is the path of a fact, `kind` the kind of query or shape, or "". Return false if
 * memory runs out. */
bool cause_origins_add(cause_origins *o, uint64_t tick, const char *where, const char *kind);
void cause_origins_sort(cause_origins *o);
void cause_origins_release(cause_origins *o);

/* Advance to a tick. Call it after cause_origins_sort(), in ascending order, for each tick that both sessions have.
 * `games_differ`: the states of the games differ; `other_heat`: the heat that is drawn differs. Return false if memory
 * runs out. */
bool cause_origins_advance(cause_origins *o, uint64_t tick, bool games_differ, bool other_heat);

/* The causes in effect at a tick; "" for none. Frames also show keys of the ticks just before and after, so those count
 * if nothing else is in effect. */
const char *cause_origins_at(const cause_origins *o, uint64_t tick);

/* Whether the frame of `tick` can show a difference at the tick `origin`. */
bool cause_origin_shows(const char *where, uint64_t origin, uint64_t tick);

#endif
