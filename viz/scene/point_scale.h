/* SPDX-License-Identifier: MIT */
/* point_scale.h - what the points of tick 0 are like, so that colours and sizes of painted points stay the same through
 * a recording. */
#ifndef SCENE_POINT_SCALE_H
#define SCENE_POINT_SCALE_H

#include "camera.h"
#include "octree/types.h"
#include "point_values.h"
#include "view.h"

/* Where the view paints points and has no scale yet, give it that of the points that it shows of the tree of tick 0. A
 * few outliers on either side are left out, so that they do not take the colours from all others: what remains does not
 * depend on the tree, so that pictures of other leaf capacities have the same colours. The spacing is the median of the
 * leaves', by the extent of the points in each. The values of the points may be null; of those that no
 * point of the tree has none counts: a session that is filmed while it is written has them later. False when there is
 * no memory. Cost: O(n). */
bool point_scale_fit(view *v, const octree *tree, const point_values *values);

/* What the view colours points by and none of them has: "a class"; null where that is nothing. */
const char *point_scale_lacks(const view *v, const point_values *values);

/* A painted point is this much wider than it is from one point to the next: more than the diagonal of a grid, so that
 * surfaces are closed; but no wider than so many units of the frame. */
#define POINT_OVERLAP 1.5
#define POINT_WIDEST 8

/* Pixels of a length in world units; under perspective, at distance 1. */
double point_scale_pixels(const camera *c, double length);

#endif
