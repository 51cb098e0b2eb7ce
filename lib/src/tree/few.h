/* SPDX-License-Identifier: MIT */
/* few.h - batches of few points in a large tree, changed in the given order with overlapping cache misses. */
#ifndef OCTREE_FEW_H
#define OCTREE_FEW_H

#include "batch.h"

/* Returns whether `count` points are so few that the functions below are faster than sorting. */
bool is_small_batch(const octree *tree, size_t count);

/* Insert the points of the batch. A point whose leaf has room is inserted at once; the other points are inserted as one
 * batch at the end. */
octree_status insert_small_batch(batch *b);

/* Remove the points of the batch. All ids of the batch must differ. */
octree_status remove_small_batch(batch *b);

/* Returns whether a batch of moves is so small that move_small_batch() is faster than sorting. */
bool is_small_batch_of_moves(const batch *b);

/* Move points one by one and log the moves. *done receives the number of points that moved; `done` may be null. The
 * caller's arrays must not lie in the tree's memory. For up to FEW_AT_ONCE moves, the list of moves is on the stack. */
enum { FEW_AT_ONCE = 32 };
octree_status move_small_batch(const batch *b, size_t *done);

/* Insert any number of points, sorted by Morton code (bulk.c). */
octree_status insert_in_morton_order(batch *b);

#endif
