/* SPDX-License-Identifier: MIT */
/* recount.h - recounts the nodes that the queries of a tick visited: a walk over all nodes compares their boxes.
 *
 * The comparisons use doubles. They are correct for boxes and balls whose faces and squares are exact, as with small
 * dyadic coordinates, and for all boxes and balls whose faces are not close to the planes of nodes. */
#ifndef RECOUNT_H
#define RECOUNT_H

#include "octree/game.h"

typedef struct recount {
    octree_visit *visits; /* after recount_tick: each node once, with its strongest kind of visit, in pre-order */
    size_t count, room;
    size_t touched[OCTREE_TRACE_KINDS];
    octree_address *leaves; /* leaves with hits or answers, in pre-order */
    size_t leaf_count, leaf_room;
} recount;

/* An empty recount is {0}. */
void recount_free(recount *all);

/* Add the nodes that intersect a box or a ball; returns the cost of the query. */
octree_cost recount_box(recount *all, const octree *tree, const octree_box *box);
octree_cost recount_ball(recount *all, const octree *tree, const double center[3], double radius);

/* Add the nodes of a neighbour query. They come from its trace, which the test of traces checks by distances. */
octree_cost recount_neighbors(recount *all, const octree *tree, const double target[3], size_t k,
                              const octree_search *how);

/* Add the nodes of a ray. They come from its trace, too. */
octree_cost recount_ray(recount *all, const octree_bodies *bodies, const octree_answer *ray, const octree_search *how);

/* Recount the last tick of the game; the test fails if the tick has other costs. `before` is the player's position at
 * the tick before: the collision test ran while the player was still there. */
void recount_tick(recount *all, const octree_game *game, const double before[3]);

/* The test fails unless the tick has exactly these visits and leaves. */
void assert_recount(const recount *all, const octree_tick *tick);

#endif
