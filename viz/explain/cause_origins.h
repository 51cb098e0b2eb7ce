/* SPDX-License-Identifier: MIT */
/* cause_origins.h - what differs in single ticks of two sessions, and which ticks that reaches: by it the frames of one
 * cause are told from those of others.
 *
 * Another key or edit reaches from its tick on, as long as the games differ; another query its own tick, and where heat
 * is shown all later ones. What is in force in ticks that follow each other is one cause, from the first of them on.
 */
#ifndef EXPLAIN_CAUSE_ORIGINS_H
#define EXPLAIN_CAUSE_ORIGINS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What differs: "keys", "edits", "queries radius". */
#define CAUSE_KIND 64
typedef struct cause_kind {
    char name[CAUSE_KIND];
    uint64_t since; /* while games are played: in force from this tick on; CAUSE_NO_TICK: it is not */
} cause_kind;

typedef struct cause_origin {
    uint64_t tick;
    size_t kind;
} cause_origin;

/* Ticks that all have the same causes, up to the next stretch. */
typedef struct cause_stretch {
    uint64_t first;
    char *causes; /* "keys 14, queries radius 15": each kind, and since when; null for none; owned */
} cause_stretch;

/* A zeroed one is empty. */
typedef struct cause_origins {
    cause_kind *kinds;
    size_t kind_count, kind_room;
    cause_origin *listed; /* in ascending order of ticks when they are sorted */
    size_t count, room, next;
    cause_stretch *stretches;
    size_t stretch_count, stretch_room;
} cause_origins;

/* Note that something differs in a tick: where, as in a fact, and of which kind it is there, or "". False when there is
 * no memory. */
bool cause_origins_add(cause_origins *o, uint64_t tick, const char *where, const char *kind);
void cause_origins_sort(cause_origins *o);
void cause_origins_release(cause_origins *o);

/* To be called at each tick that both have, in ascending order, when all are sorted: whether the games differ in it,
 * and whether other heat is shown. False when there is no memory. */
bool cause_origins_reach(cause_origins *o, uint64_t tick, bool games_differ, bool other_heat);

/* The causes in force in a tick, or that its frame shows beforehand or still, as it does keys; "" for none. */
const char *cause_origins_at(const cause_origins *o, uint64_t tick);

/* Whether the frame of a tick can show what differs at another one. */
bool cause_origin_shows(const char *where, uint64_t origin, uint64_t tick);

#endif
