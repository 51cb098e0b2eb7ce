/* SPDX-License-Identifier: MIT */
/* body_sets.h - small sets of bodies for tests. */
#ifndef BODY_SETS_H
#define BODY_SETS_H

#include "octree/bodies.h"

/* Create an empty set. */
octree_bodies *make_body_set(octree_box world, size_t capacity);

/* A cube with this half extent on all axes. */
octree_body body_at(double x, double y, double z, double half, uint64_t id);

/* A random body in [-8, 8]^3 whose half extents are at most `reach`. */
octree_body small_body(double reach, uint64_t *seed, uint64_t id);

/* Visitors that add 1 to a size_t. */
bool count_body(const octree_body *body, void *count);
bool count_pair(const octree_body *a, const octree_body *b, void *count);

#endif
