/* SPDX-License-Identifier: MIT */
/* moving_bodies.h - a program whose bodies come, move, change their extents and leave at random, for tests of the
 * recorder, and the session that a recording of it must have. The session is found without the recorder's code: from
 * the bodies before and after each tick. */
#ifndef MOVING_BODIES_H
#define MOVING_BODIES_H

#include "octreel/recorder.h"

#define MOVING_BODIES_MOST 24

/* How a program hands its bodies to the recorder: as changes, a list, or a set. */
typedef enum bodies_source { BODIES_CHANGES, BODIES_LIST, BODIES_SET, BODIES_SOURCES } bodies_source;

typedef struct moving_body_slot {
    octree_body body; /* its id grows with the slot */
    bool alive;
} moving_body_slot;

typedef struct moving_bodies {
    uint64_t random;
    octree_bodies *set;
    moving_body_slot now[MOVING_BODIES_MOST], recorded[MOVING_BODIES_MOST]; /* `recorded`: at the last accepted tick */
    /* the expected session: */
    octree_game_body first[MOVING_BODIES_MOST];
    octree_edit edits[8192];
    octree_gap gaps[8];
    octree_session session;
    uint64_t ticks; /* number of its ticks and gaps */
} moving_bodies;

/* Make some bodies in and near the world [-8, 8]^3. The structure must not be moved. */
void moving_bodies_make(moving_bodies *m, uint64_t seed);
void moving_bodies_release(moving_bodies *m);

/* Change some bodies. */
void moving_bodies_step(moving_bodies *m);

/* Record a tick. If it is accepted, add it to the expected session. */
octreel_status moving_bodies_record(moving_bodies *m, octreel_recorder *recorder, bodies_source source);

/* Add a gap to the expected session. */
void moving_bodies_expect_gap(moving_bodies *m, const char *why);

/* Expect a session that begins with the next tick. */
void moving_bodies_forget_ticks(moving_bodies *m);

/* The test fails unless the session.json of a recording is the expected session. */
void moving_bodies_assert_recorded(moving_bodies *m, const char *folder);

#endif
