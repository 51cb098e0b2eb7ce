/* SPDX-License-Identifier: MIT */
/* queries.h - asking the queries of a tick, and listing the nodes that its searches visited. Private. */
#ifndef OCTREE_QUERIES_H
#define OCTREE_QUERIES_H

#include "kind.h"
#include "octree/game.h"

/* A search whose cost is added to *cost, and whose visited nodes are recorded in the tick. `cost` may be null. */
octree_search game_search_options(octree_game *game, octree_cost *cost);

/* Ask some of a tick's queries, which have been checked, or the query of the key n if this is the tick's key. False
 * when there is no memory. */
bool game_ask_queries(octree_game *game, const octree_query *queries, size_t count);
bool game_ask_by_key(octree_game *game);

/* After all searches of a tick: set the result pointers of the answers, sort and count the visited nodes, and list the
 * leaves that hold a result. False when there is no memory. */
bool game_finish_queries(octree_game *game);

#endif
