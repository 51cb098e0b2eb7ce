/* SPDX-License-Identifier: MIT */
/* point_scale.h - the ranges of position, id and intensity of the points of tick 0, and their spacing. They map values
 * to colours and sizes of painted points, and stay the same through a recording. */
#ifndef SCENE_POINT_SCALE_H
#define SCENE_POINT_SCALE_H

#include "camera.h"
#include "octree/types.h"
#include "point_values.h"
#include "view.h"

/* If the view paints points and has no scale yet, compute it from the points that the view shows in the tree of tick 0.
 * `values` may be null; values of ids that the tree does not hold are ignored, because a session that is still being
 * written gets them later. False if there is no memory. Cost: O(points). point_scale.c explains the method. */
bool point_scale_compute(view *v, const octree *tree, const point_values *values);

/* The value by which the view colours points if no point has it, as in "a class"; null if some point has it. */
const char *point_scale_missing_value(const view *v, const point_values *values);

/* The width of a painted point relative to the spacing: more than the diagonal of a grid cell, so that surfaces have no
 * holes. And its greatest width, in units of the frame. */
#define POINT_OVERLAP 1.5
#define POINT_WIDEST 8

/* Pixels of a length in world units; under perspective, at distance 1. */
double point_scale_length_in_pixels(const camera *c, double length);

#endif
