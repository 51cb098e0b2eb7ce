/* SPDX-License-Identifier: MIT */
/* recount.h - what a tick's questions met, counted anew: by a walk over all nodes that looks at their boxes alone.
 *
 * Comparisons are plain ones of doubles: true for boxes and balls whose faces and squares are exact, as those of small
 * dyadic coordinates are, and for those that keep clear of planes.
 */
#ifndef RECOUNT_H
#define RECOUNT_H

#include "octree/game.h"

typedef struct recount {
    octree_visit *visits; /* after recount_tick: each node once, the strongest touch, in pre-order */
    size_t count, room;
    size_t touched[OCTREE_TRACE_KINDS];
    octree_address *leaves; /* of the hits and answers, in pre-order */
    size_t leaf_count, leaf_room;
} recount;

/* An empty one is {0}. */
void recount_free(recount *all);

/* Add the nodes that a box or a ball meets; returns what the question costs. */
octree_cost recount_box(recount *all, const octree *tree, const octree_box *box);
octree_cost recount_ball(recount *all, const octree *tree, const double center[3], double radius);

/* Add the nodes that a neighbour query met: by its own trace, which the test of traces holds against the distances. */
octree_cost recount_neighbors(recount *all, const octree *tree, const double target[3], size_t k,
                              const octree_search *how);

/* Count the game's last tick anew, and hold the costs that it tells against those counted. `before` is the player's
 * place at the tick before: the collision test was made with the player still there. */
void recount_tick(recount *all, const octree_game *game, const double before[3]);

/* The test fails unless the tick tells just these visits and leaves. */
void assert_recount(const recount *all, const octree_tick *tick);

#endif
