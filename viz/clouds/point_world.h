/* SPDX-License-Identifier: MIT */
/* point_world.h - computes the world of a tree from its points, for users who give no world. */
#ifndef CLOUDS_POINT_WORLD_H
#define CLOUDS_POINT_WORLD_H

#include "octree/types.h"

/* Returns the smallest cube whose rounded faces contain every point. The centre of the cube is the centre of the
 * points' bounding box. The side of the cube is the largest extent of the points, but at least 4 ulp of the largest
 * coordinate. If all points are equal, the side is at least 1. `positions` holds `count` points (at least 1) of
 * three finite doubles; successive points are `stride` bytes apart. Cost: O(count). */
octree_box find_point_world(const void *positions, size_t stride, size_t count);

#endif
