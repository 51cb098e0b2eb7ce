/* cause.h - two sessions played side by side: in what they differ, at which ticks, and how. */
#ifndef CAUSE_H
#define CAUSE_H

#include "cause_compare.h"
#include "folder.h"

/* A tick that is told in detail. */
typedef struct cause_tick {
    uint64_t tick;
    cause_facts facts; /* none: nothing that happened differs */
} cause_tick;

/* Which ticks are told in detail: the first so many that differ, and those of a list besides. */
typedef struct cause_wanted {
    size_t first;
    const uint64_t *ticks; /* in ascending order */
    size_t count;
} cause_wanted;

/* A zeroed one is empty. */
typedef struct cause {
    cause_facts session; /* in what the sessions differ */
    cause_facts view;    /* and how they are looked at; of two sessions alone there is none */
    cause_tick *ticks;   /* told in detail, in ascending order */
    size_t count, room;
    uint64_t compared;    /* ticks that both have */
    uint64_t differing;   /* of them, in what happened */
    uint64_t first, last; /* of those that differ */
} cause;

/* Called at each tick that both have, with the games at it, and whether what happened differs. False, with a sentence,
 * ends the playing. */
typedef bool cause_watch(void *context, const octree_game *const games[2], bool differs, octreel_error *error);

/* Compare two sessions and play them side by side. `views`, which may be null, add what shows in pictures
 * alone. `watch` may be null. False with a sentence when one cannot be played; *c is to be released in any
 * case. */
bool cause_find(const octree_session *a, const octree_session *b, const cause_view views[2], const cause_wanted *wanted,
                cause_watch *watch, void *context, cause *c, octreel_error *error);
void cause_release(cause *c);

/* The facts of a tick that is told in detail, or null. */
const cause_tick *cause_at(const cause *c, uint64_t tick);

#endif
