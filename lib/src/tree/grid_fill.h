/* SPDX-License-Identifier: MIT */
/* grid_fill.h - a tree of points that are spread evenly: they are counted in the cells of a grid, which gives the nodes
 * above it, and each point is written straight into its leaf. So a point is read twice and written once, and none is
 * sorted but for those of cells that hold more than a leaf takes.
 */
#ifndef OCTREE_GRID_FILL_H
#define OCTREE_GRID_FILL_H

#include "batch.h"

/* The cell of a point that is left out. */
#define GRID_NONE GRID_UNSURE

enum { GRID_TOGETHER = 64 }; /* cells are found of so many positions at a time */

/* Choose the depth of a grid for `total` points that are spread as the batch's are after its changes; none where a
 * sample shows that they are not spread evenly enough. False when there is no memory. */
bool grid_choose(batch *b, size_t total);

/* Items for the points of a batch, and for those of `stored`, that have cells. Returns how many; *filter, when it is
 * not null, has a null for each cell that is wanted. */
size_t grid_items(const batch *b, octree_point *const *filter, morton_item *items);

/* Make the root of a tree of the points that have cells; no two have one id. False when there is no memory; *made then
 * holds what was made. Cost: O(count). */
bool grid_fill(batch *b, node *made);

#endif
