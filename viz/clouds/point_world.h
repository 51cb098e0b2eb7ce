/* SPDX-License-Identifier: MIT */
/* point_world.h - chooses the world of points if the user does not give a world. */
#ifndef CLOUDS_POINT_WORLD_H
#define CLOUDS_POINT_WORLD_H

#include "octree/types.h"

/* Returns the smallest cube, centred on the bounding box of the points, whose rounded faces contain every point. Its
 * side is the largest extent of the points, but at least 4 ulp of the largest coordinate. If all points are equal,
 * its side is at least 1. `positions` holds `count` points (at least 1) of three finite doubles, `stride` bytes
 * apart. Cost: O(count). */
octree_box find_point_world(const void *positions, size_t stride, size_t count);

#endif
