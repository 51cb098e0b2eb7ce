/* SPDX-License-Identifier: MIT */
/* point_colors.h - the colours of points, where a view paints them. */
#ifndef LAYERS_POINT_COLORS_H
#define LAYERS_POINT_COLORS_H

#include "legend.h"
#include "point_values.h"
#include "scene.h"

/* Give colours to markers of points of one leaf, by the view's point_color and its scale; a point that lacks the value
 * is of the colour of marks. Under POINTS_BY_DENSITY draw counts the points of a pixel. The values may be null. */
void color_points(const view *v, const point_values *values, const octree_node *leaf, scene_marker *markers,
                  size_t count);

/* The lines of the legend about points. */
void add_point_legend(legend *l, const layer_source *in);

/* What theme_kind() of a class stands for: those of LAS that are alike share one; beyond them 7, "other". */
unsigned kind_of_class(unsigned class);
extern const char *const class_kind_names[THEME_KINDS];

#endif
