/* SPDX-License-Identifier: MIT */
/* changed_session.h - a random session and a copy with one change, for tests that find the change. */
#ifndef CHANGED_SESSION_H
#define CHANGED_SESSION_H

#include "cause_facts.h"
#include "random_session.h"

#define CHANGED_SHAPES 8

/* A random session, its copy with one change, and a description of the change. */
typedef struct changed_session {
    random_session made;
    octree_session changed;
    octree_shape shapes[2][CHANGED_SHAPES]; /* of both */
    octree_game_body bodies[RANDOM_SESSION_BODIES];
    octree_edit edits[RANDOM_SESSION_EDITS + 1];
    const char *where; /* the expected fact: where the change is, and how */
    cause_change change;
    uint64_t tick, id; /* of the expected fact; or CAUSE_NO_TICK, CAUSE_NO_ID */
    char text[640];    /* the expected beginning of the headline */
} changed_session;

/* Make a session and change it, at a tick if the change has one. False if the session has nothing to change. */
typedef bool session_change(changed_session *t, uint64_t tick, uint64_t *state);
bool try_change(changed_session *t, uint64_t seed, session_change *change);

session_change move_by_one_step; /* add an edit that moves a point by the length of the player's step */
session_change add_one_point;    /* add an edit that inserts a point */
session_change change_capacity;
session_change change_step;
session_change change_kind;     /* change the kind of the player; not both kinds use the step and the start */
session_change change_velocity; /* of a point at the start */
session_change change_half;     /* change the half extents of a body at the start */
session_change change_pairs;    /* list the overlaps of bodies, or no longer */
session_change change_number_of_shapes;
session_change change_shape;

#endif
