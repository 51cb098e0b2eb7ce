/* SPDX-License-Identifier: MIT */
/* point_scale.h - the ranges of position, id and intensity of the points of tick 0, and the spacing of these points.
 * Ranges and spacing map values to the colours and sizes of painted points, and stay the same throughout a
 * recording. */
#ifndef SCENE_POINT_SCALE_H
#define SCENE_POINT_SCALE_H

#include "camera.h"
#include "octree/types.h"
#include "point_values.h"
#include "view.h"

/* If the view paints points and has no scale yet, compute the scale from the points that the view shows in the tree of
 * tick 0. `values` may be null. Values of ids that the tree of tick 0 does not hold are ignored: a later tick of a
 * session may insert these points. Returns false if memory runs out. Cost: O(points). point_scale.c explains the
 * method. */
bool point_scale_compute(view *v, const octree *tree, const point_values *values);

/* If the view colours points by a value that no point has, returns a phrase for this value, such as "a class".
 * Otherwise returns null. */
const char *point_scale_missing_value(const view *v, const point_values *values);

/* POINT_OVERLAP: the width of a painted point relative to the spacing of points. It exceeds the diagonal of a grid
 * cell, so that surfaces have no holes. POINT_WIDEST: the greatest width of a painted point, in picture units. */
#define POINT_OVERLAP 1.5
#define POINT_WIDEST 8

/* Converts a length in world units to pixels; under perspective, for a length at distance 1 from the eye. */
double point_scale_length_in_pixels(const camera *c, double length);

#endif
