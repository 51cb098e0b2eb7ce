/* SPDX-License-Identifier: MIT */
/* queries.h - asks the queries of a tick, and lists the nodes that its searches visited. Private. */
#ifndef OCTREE_QUERIES_H
#define OCTREE_QUERIES_H

#include "../query/kind.h"
#include "octree/game.h"

/* Options for a search whose cost is added to *cost and whose visited nodes are recorded in the tick. `cost` may be
 * null. */
octree_search game_search_options(octree_game *game, octree_cost *cost);

/* game_ask_queries() asks some of a tick's queries, which were checked before. game_ask_by_key() asks the query of the
 * key n if n is the tick's key. False when there is no memory. */
bool game_ask_queries(octree_game *game, const octree_query *queries, size_t count);
bool game_ask_by_key(octree_game *game);

/* Finish the queries after all searches of a tick. Set the result pointers of the answers, sort and count the visited
 * nodes, and list the leaves that hold a result. False when there is no memory. */
bool game_finish_queries(octree_game *game);

#endif
