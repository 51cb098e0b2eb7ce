/* SPDX-License-Identifier: MIT */
/* queries.h - answers the queries of a tick, and lists the nodes that the searches visited. Private. */
#ifndef OCTREE_QUERIES_H
#define OCTREE_QUERIES_H

#include "../ask/kind.h"
#include "octree/game.h"

/* Returns the options of a search, whose tracer records in the tick the nodes that the search visits, takes whole or
 * prunes. The search adds its cost to *cost; `cost` may be null. */
octree_search game_make_search_options(octree_game *game, octree_cost *cost);

/* game_run_queries() asks `count` queries, which have been checked. If the player's key in this tick is n,
 * game_run_query_of_key() asks for the point nearest to the player. Both return false if memory runs out. */
bool game_run_queries(octree_game *game, const octree_query *queries, size_t count);
bool game_run_query_of_key(octree_game *game);

/* Finish the queries after all searches of a tick. Set the pointers of the answers to their results, sort and count the
 * visited nodes, and list the leaves that hold a result. Returns false if memory runs out. */
bool game_finish_queries(octree_game *game);

#endif
