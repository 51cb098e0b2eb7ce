/* SPDX-License-Identifier: MIT */
/* point_scale.h - the ranges of position, id and intensity of the points of tick 0, and the spacing of these points.
 * They map values to the colours and sizes of painted points, and stay the same throughout a recording. */
#ifndef SCENE_POINT_SCALE_H
#define SCENE_POINT_SCALE_H

#include "camera.h"
#include "octree/types.h"
#include "point_values.h"
#include "view.h"

/* If the view paints points and has no scale yet, compute the scale from the points that the view shows in the tree of
 * tick 0. `values` may be null. It may also hold values of ids that the tree does not hold, since a session that is
 * still being written inserts them later; such values are ignored. False when out of memory. Cost: O(points).
 * point_scale.c explains the method. */
bool point_scale_compute(view *v, const octree *tree, const point_values *values);

/* If the view colours points by a value that no point has, returns this value, as in "a class"; otherwise returns
 * null. */
const char *point_scale_missing_value(const view *v, const point_values *values);

/* The width of a painted point relative to the spacing of points: more than the diagonal of a grid cell, so that
 * surfaces have no holes. Then the greatest width of a painted point, in units of the frame. */
#define POINT_OVERLAP 1.5
#define POINT_WIDEST 8

/* Returns the number of pixels of a length in world units; under perspective, of a length at distance 1. */
double point_scale_length_in_pixels(const camera *c, double length);

#endif
