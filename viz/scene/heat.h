/* SPDX-License-Identifier: MIT */
/* heat.h - for each node of a game: in how many ticks queries visited it, and the sum of its points over all ticks. It
 * is updated at every tick and depends only on the session, not on the view.
 */
#ifndef SCENE_HEAT_H
#define SCENE_HEAT_H

#include "hash_map.h"
#include "octree/game.h"

#include <stdbool.h>

/* The totals of an address over the ticks in which it had a node. */
typedef struct heat_cell {
    octree_address node;
    uint64_t visits; /* ticks in which a query visited it, or took it or an ancestor whole */
    uint64_t points; /* in its subtree, summed over the ticks */
} heat_cell;

/* Zeroed: before tick 0. */
typedef struct heat {
    heat_cell *cells;
    size_t room;
    hash_map places; /* index of a cell by its node */
    bool incomplete; /* a cell is missing, because there was no memory */
} heat;

void heat_release(heat *h);

/* Add the game's current tick. False if there is no memory: the heat is then incomplete. Cost: O(nodes + visits). */
bool heat_add_tick(heat *h, const octree_game *game);

/* The totals of an address; all zero when it never had a node, or h is null. */
heat_cell heat_get_cell(const heat *h, octree_address node);

#endif
