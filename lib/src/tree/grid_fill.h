/* SPDX-License-Identifier: MIT */
/* grid_fill.h - builds a tree from evenly spread points by counting them in a grid instead of sorting them. */
#ifndef OCTREE_GRID_FILL_H
#define OCTREE_GRID_FILL_H

#include "batch.h"

/* The cell number of a point that will not be in the tree. */
#define GRID_NONE GRID_UNSURE

enum { GRID_TOGETHER = 64 }; /* the number of positions whose cells are computed in one call */

/* Choose the depth of a grid for `total` points, and store the depth in b->grid. The points are assumed to be
 * distributed like the points of the batch, at their destinations if the batch moves points. If a sample shows that the
 * batch's points are not spread evenly, b->grid stays 0. Returns false if memory runs out. */
bool choose_grid(batch *b, size_t total);

/* Store the grid cells of `count` points in cells[], for the grid of the batch. A point outside the world gets
 * GRID_NONE. `statuses` may be null. If it is not null, it receives OK for each point, or the reason why the point has
 * no cell. */
void find_grid_cells(const batch *b, const octree_point *points, size_t count, uint32_t *cells,
                     octree_status *statuses);

/* Make items (Morton code and index) for the points of the batch and of `stored` that have a grid cell. Returns the
 * number of items. If `filter` is not null, it has one pointer for each grid cell, and points in cells with a non-null
 * pointer get no item. */
size_t make_grid_items(const batch *b, octree_point *const *filter, morton_item *items);

/* Build a tree of the points that have grid cells. *made receives the root. All ids must differ. Returns false if
 * memory runs out; *made is then an incomplete tree. Cost: O(count). */
bool build_from_grid(batch *b, node *made);

#endif
