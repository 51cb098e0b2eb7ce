/* SPDX-License-Identifier: MIT */
/* grid_fill.h - builds a tree from evenly spread points by counting them in a grid instead of sorting them. */
#ifndef OCTREE_GRID_FILL_H
#define OCTREE_GRID_FILL_H

#include "batch.h"

/* The cell number of a point that does not become part of the tree. */
#define GRID_NONE GRID_UNSURE

enum { GRID_TOGETHER = 64 }; /* the number of positions whose cells are computed in one call */

/* Choose the depth of a grid for `total` points and store it in b->grid. The points are assumed to have the
 * distribution of the batch's points after their changes. If a sample shows that they are not spread evenly, b->grid
 * stays 0. False when there is no memory. */
bool choose_grid(batch *b, size_t total);

/* Find the cells of adjacent points in the grid of the batch. A point outside the world gets GRID_NONE. `statuses` may
 * be null; else it receives OK, or the reason why a point has no cell. */
void find_grid_cells(const batch *b, const octree_point *points, size_t count, uint32_t *cells,
                     octree_status *statuses);

/* Make items for those points of the batch and of `stored` that have a cell. Returns the number of items. If `filter`
 * is not null, points are left out unless the filter's entry for their cell is null. */
size_t make_grid_items(const batch *b, octree_point *const *filter, morton_item *items);

/* Build a tree of the points that have cells, with its root in *made. All ids must differ. False when there is no
 * memory; *made then holds the incomplete tree. Cost: O(count). */
bool build_from_grid(batch *b, node *made);

#endif
