/* SPDX-License-Identifier: MIT */
/* few.h - batches of few points in a large tree, changed in the given order with overlapping cache misses. */
#ifndef OCTREE_FEW_H
#define OCTREE_FEW_H

#include "batch.h"

/* Whether `count` points are few enough for these functions to be faster than sorting. */
bool are_few(const octree *tree, size_t count);

/* Insert points: those whose leaf has room one by one, the others as one batch at the end. */
octree_status insert_few(batch *b);

/* Remove points whose ids all differ. */
octree_status remove_few(batch *b);

/* Insert any number of points in Morton order (bulk.c). */
octree_status insert_in_morton_order(batch *b);

#endif
