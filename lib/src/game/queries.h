/* SPDX-License-Identifier: MIT */
/* queries.h - the queries of a tick, and the nodes that its searches visited. Private. */
#ifndef OCTREE_QUERIES_H
#define OCTREE_QUERIES_H

#include "pool.h"
#include "octree/game.h"

/* A visitor that appends points to a list of octree_point; it stops, and says so, when there is no memory. */
typedef struct point_collector {
    arena *memory;
    list *points;
    bool failed;
} point_collector;

bool collect_point(const octree_point *point, void *context);

/* Sort a list of points by id, then position, from an index on. */
void sort_points(list *points, size_t first);

/* A search that adds to `cost` and to the tick's visits. */
octree_search game_search(octree_game *game, octree_cost *cost);

/* Answer some of a tick's queries, or the query of its key. */
octree_status game_ask(octree_game *game, const octree_query *queries, size_t count);
octree_status game_ask_by_key(octree_game *game);

/* After all searches: give the answers their results, sort and count the visits, list the leaves of what was found. */
octree_status game_finish_asking(octree_game *game);

#endif
