/* SPDX-License-Identifier: MIT */
/* random_session.h - sessions made of random numbers, the same for the same seed.
 *
 * All coordinates are multiples of 1/4 of modest size, so that plain double arithmetic on them is exact.
 */
#ifndef RANDOM_SESSION_H
#define RANDOM_SESSION_H

#include "octree/game.h"

#define RANDOM_SESSION_BODIES 64
#define RANDOM_SESSION_KEYS 160
#define RANDOM_SESSION_EDITS 80
#define RANDOM_SESSION_QUERIES 40

/* A session and the arrays that the session points into. The structure must not be moved. */
typedef struct random_session {
    octree_session session;
    octree_game_body bodies[RANDOM_SESSION_BODIES];
    char keys[RANDOM_SESSION_KEYS + 1];
    octree_edit edits[RANDOM_SESSION_EDITS];
    octree_query queries[RANDOM_SESSION_QUERIES];
} random_session;

/* A session that the paper can play: resting bodies, no edits, and one query, the player's nearest neighbour. */
void random_session_plain(random_session *made, uint64_t seed);

/* A session with velocities, edits (some with duplicate or unknown ids) and queries of every kind. One in three such
 * sessions has swept collisions. */
void random_session_full(random_session *made, uint64_t seed);

/* The same session with extents: most bodies, also those that edits insert, are boxes, some flat and some large; and
 * each tick lists its pairs. */
void random_session_boxes(random_session *made, uint64_t seed);

/* random_session_full() for even seeds, random_session_boxes() for odd seeds. */
void random_session_mixed(random_session *made, uint64_t seed);

#endif
