/* SPDX-License-Identifier: MIT */
/* few.h - batches of few points in a large tree, changed in the given order with overlapping cache misses. */
#ifndef OCTREE_FEW_H
#define OCTREE_FEW_H

#include "batch.h"

/* Returns whether `count` points are so few that the functions below are faster than sorting. */
bool is_small_batch(const octree *tree, size_t count);

/* Insert points. A point whose leaf has room is inserted at once. The other points are inserted as one batch at the
 * end. */
octree_status insert_small_batch(batch *b);

/* Remove points. All ids of the batch must differ. */
octree_status remove_small_batch(batch *b);

/* Insert any number of points in Morton order (bulk.c). */
octree_status insert_in_morton_order(batch *b);

#endif
