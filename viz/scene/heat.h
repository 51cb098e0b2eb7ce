/* heat.h - what the nodes of a game have seen since tick 0. It grows with the game, tick by tick, and knows nothing of
 * pictures: whoever plays the same session has the same heat at the same tick.
 */
#ifndef SCENE_HEAT_H
#define SCENE_HEAT_H

#include "hash_map.h"
#include "octree/game.h"

#include <stdbool.h>

/* What an address has seen in the ticks in which it had a node. */
typedef struct heat_cell {
    octree_address node;
    uint64_t visits; /* ticks whose questions looked into it, or took it whole or with one above it */
    uint64_t points; /* the points in and below it, added up over the ticks */
} heat_cell;

/* A zeroed one is that before tick 0. */
typedef struct heat {
    heat_cell *cells;
    size_t room;
    hash_map places; /* of cells by their nodes */
} heat;

void heat_release(heat *h);

/* Add the tick that the game has played last. False when there is no memory: the heat is then not whole. Cost: O(nodes
 * + visits). */
bool heat_add_tick(heat *h, const octree_game *game);

/* What an address has seen; all zero where it never had a node, or there is no heat. */
heat_cell heat_at(const heat *h, octree_address node);

#endif
