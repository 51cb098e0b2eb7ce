/* SPDX-License-Identifier: MIT */
/* heat.h - the heat of a game: for each node, the number of ticks in which queries visited the node, and the node's
 * number of points, summed over all ticks. The heat is updated at every tick. The heat depends only on the session, not
 * on the view. */
#ifndef SCENE_HEAT_H
#define SCENE_HEAT_H

#include "hash_map.h"
#include "octree/game.h"

#include <stdbool.h>

/* The heat of one node address. Ticks in which no node has this address add nothing. */
typedef struct heat_cell {
    octree_address node;
    /* the number of ticks in which a query visited the node; if a query takes a node whole, all descendants count as
     * visited */
    uint64_t visits;
    uint64_t points; /* the number of points in the node's subtree, summed over the ticks */
} heat_cell;

/* The heat of all nodes. A zeroed struct is the heat before tick 0. */
typedef struct heat {
    heat_cell *cells;
    size_t room;
    hash_map places; /* maps a node's address to the index of its cell */
    bool incomplete; /* true: a cell is missing, because memory ran out */
} heat;

void heat_release(heat *h);

/* Add the game's current tick to the heat. Returns false if memory runs out: the heat is then incomplete. Cost: O(nodes
 * + visits). */
bool heat_add_tick(heat *h, const octree_game *game);

/* Returns the heat of a node's address. All members are zero if no node ever had this address, or if `h` is null. */
heat_cell heat_get_cell(const heat *h, octree_address node);

#endif
