/* SPDX-License-Identifier: MIT */
/* heat.h - how often each node of a game was visited, and how many points it held, since tick 0. It is updated tick by
 * tick and depends on the session alone, not on the view.
 */
#ifndef SCENE_HEAT_H
#define SCENE_HEAT_H

#include "hash_map.h"
#include "octree/game.h"

#include <stdbool.h>

/* The totals of an address over the ticks in which it had a node. */
typedef struct heat_cell {
    octree_address node;
    uint64_t visits; /* ticks whose queries visited it, or took it or an ancestor whole */
    uint64_t points; /* the points in and below it, summed over the ticks */
} heat_cell;

/* All zero: before tick 0. */
typedef struct heat {
    heat_cell *cells;
    size_t room;
    hash_map places; /* of cells by their nodes */
} heat;

void heat_release(heat *h);

/* Add the game's last tick. False when there is no memory: the heat is then incomplete. Cost: O(nodes
 * + visits). */
bool heat_add_tick(heat *h, const octree_game *game);

/* The totals of an address; all zero when it never had a node, or h is null. */
heat_cell heat_at(const heat *h, octree_address node);

#endif
