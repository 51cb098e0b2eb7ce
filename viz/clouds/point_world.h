/* SPDX-License-Identifier: MIT */
/* point_world.h - the world of points for which none is named. */
#ifndef CLOUDS_POINT_WORLD_H
#define CLOUDS_POINT_WORLD_H

#include "octree/octree.h"

/* The smallest cube, about the points' middle, whose rounded faces contain every point. Its side is the largest extent,
 * but at least 4 ulp of the largest coordinate, and 1 where all points are equal. There are `count` points, at least 1,
 * of three finite doubles each, which begin `stride` bytes after those of the one before. Cost: O(count). */
octree_box point_world(const void *positions, size_t stride, size_t count);

#endif
