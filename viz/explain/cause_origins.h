/* SPDX-License-Identifier: MIT */
/* cause_origins.h - finds which differences between two sessions cause the difference of each tick, so that frames with
 * the same cause form one group in a report. A "key" of a session is a key press of its player.
 *
 * The problem: one different key changes hundreds of frames, which should form one group. Frames that differ because of
 * another query at a later tick should form another group. The pixels of frames cannot decide, because each tick shows
 * another scene.
 *
 * The idea: while both sessions are played, store for each kind of difference the tick since which it is in effect. A
 * different key or edit is in effect from its tick on, while the states of the two games differ. A different query or
 * shape is in effect only at its own tick. If the view shows heat, such a query or shape is in effect at all later
 * ticks, too. Whenever the set of kinds in effect changes, a new stretch of ticks begins. A text names this set, such
 * as "keys 14, queries radius 15". All frames of the stretch form the group of this text.
 *
 * Cost: one binary search for each frame. */
#ifndef EXPLAIN_CAUSE_ORIGINS_H
#define EXPLAIN_CAUSE_ORIGINS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A kind of difference, such as "keys" (key presses of the player), "edits" or "queries radius". */
#define CAUSE_KIND 64
typedef struct cause_kind {
    char name[CAUSE_KIND];
    uint64_t since; /* the tick since which the kind is in effect; CAUSE_NO_TICK: the kind is not in effect */
} cause_kind;

/* A difference: its tick, and the index of its kind. */
typedef struct cause_origin {
    uint64_t tick;
    size_t kind;
} cause_origin;

/* A stretch: a run of successive ticks with the same causes. A stretch ends where the next stretch begins. */
typedef struct cause_stretch {
    uint64_t first;
    char *causes; /* the kinds in effect, each with its first tick: "keys 14, queries radius 15"; null: no kind is in
                     effect; owned */
} cause_stretch;

/* The differences between two sessions, and the stretches found so far. A zeroed structure is empty. */
typedef struct cause_origins {
    cause_kind *kinds;
    size_t kind_count, kind_room;
    cause_origin *listed;     /* all differences; after cause_origins_sort() in ascending order of ticks */
    size_t count, room, next; /* next: index of the first difference that cause_origins_update() has not seen */
    cause_stretch *stretches;
    size_t stretch_count, stretch_room;
} cause_origins;

/* Add a difference at a tick. `where` is the path of a fact. `kind` is the kind of query or shape, or "". Return
 * false if memory runs out. */
bool cause_origins_add(cause_origins *o, uint64_t tick, const char *where, const char *kind);
void cause_origins_sort(cause_origins *o);
void cause_origins_release(cause_origins *o);

/* Find the kinds of difference that are in effect at a tick, and begin a new stretch if they have changed. Call this
 * function after cause_origins_sort(), for each tick that both sessions have, in ascending order. `games_differ` is
 * true if the states of the games differ, `other_heat` if the drawn heat differs. Return false if memory runs out. */
bool cause_origins_update(cause_origins *o, uint64_t tick, bool games_differ, bool other_heat);

/* Return the causes in effect at a tick, or "" if there are none. A frame also shows the key presses of a few ticks
 * before and after its own tick. If no difference is in effect at the tick, the differing key presses of these
 * neighbouring ticks are the causes. */
const char *cause_origins_find_causes(const cause_origins *o, uint64_t tick);

/* Return whether the frame of `tick` can show a difference at the tick `origin`. */
bool cause_is_origin_shown(const char *where, uint64_t origin, uint64_t tick);

#endif
