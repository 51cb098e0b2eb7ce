/* SPDX-License-Identifier: MIT */
/* queries.h - answers the queries of a tick, and lists the nodes that they visited. Private. */
#ifndef OCTREE_QUERIES_H
#define OCTREE_QUERIES_H

#include "../query/kind.h"
#include "octree/game.h"

/* Make the options of a search. The search adds its cost to *cost, which may be null, and records the nodes that it
 * visits in the tick. */
octree_search game_search_options(octree_game *game, octree_cost *cost);

/* game_run_queries() asks `count` queries, which have been checked. If the player's key in this tick is n,
 * game_run_query_of_key() asks for the nearest point. Both return false when there is no memory. */
bool game_run_queries(octree_game *game, const octree_query *queries, size_t count);
bool game_run_query_of_key(octree_game *game);

/* Finish the queries after all searches of a tick. Set the pointers of the answers to their results, sort and count the
 * visited nodes, and list the leaves that hold a result. False when there is no memory. */
bool game_finish_queries(octree_game *game);

#endif
