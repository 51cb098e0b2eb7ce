/* SPDX-License-Identifier: MIT */
/* heat.h - for each node of a game: the number of ticks in which queries visited it, and the sum of its point counts
 * over all ticks. The heat is updated at every tick. It depends only on the session, not on the view. */
#ifndef SCENE_HEAT_H
#define SCENE_HEAT_H

#include "hash_map.h"
#include "octree/game.h"

#include <stdbool.h>

/* The totals of a node's address, over the ticks in which a node had this address. */
typedef struct heat_cell {
    octree_address node;
    uint64_t visits; /* the number of ticks in which a query visited the node, or took the node or an ancestor whole */
    uint64_t points; /* the number of points in the node's subtree, summed over the ticks */
} heat_cell;

/* The heat of all nodes. Zeroed: before tick 0. */
typedef struct heat {
    heat_cell *cells;
    size_t room;
    hash_map places; /* maps a node's address to the index of its cell */
    bool incomplete; /* a cell is missing, because memory ran out */
} heat;

void heat_release(heat *h);

/* Add the game's current tick. False when out of memory: the heat is then incomplete. Cost: O(nodes + visits). */
bool heat_add_tick(heat *h, const octree_game *game);

/* Returns the totals of a node's address. They are zero if no node ever had this address, or if `h` is null. */
heat_cell heat_get_cell(const heat *h, octree_address node);

#endif
