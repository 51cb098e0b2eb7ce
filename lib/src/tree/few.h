/* SPDX-License-Identifier: MIT */
/* few.h - batches of few points in a large tree. Hardly two meet in one leaf, so that sorting them gains nothing: they
 * are changed in the order given, some dozens of leaves being loaded at once.
 */
#ifndef OCTREE_FEW_H
#define OCTREE_FEW_H

#include "batch.h"

/* Whether there are so few points that this pays. */
bool are_few(const octree *tree, size_t count);

/* Those that find room in their leaf are inserted one by one, and the others, whose leaves were full and are so at the
 * end, at once. */
octree_status insert_few(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                         size_t *inserted);

/* All ids differ. */
octree_status remove_few(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                         size_t *removed);

/* Of any number. */
octree_status insert_sorted(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                            size_t *inserted);

#endif
