/* SPDX-License-Identifier: MIT */
/* point_colors.h - the colours of points, where a view paints them. */
#ifndef LAYERS_POINT_COLORS_H
#define LAYERS_POINT_COLORS_H

#include "scene.h"

/* Give colours to markers of points of one leaf, by the view's point_color and its scale. Under POINTS_BY_DENSITY they
 * have none: draw counts the points of a pixel. */
void color_points(const view *v, const octree_node *leaf, scene_marker *markers, size_t count);

#endif
