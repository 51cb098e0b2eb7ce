/* SPDX-License-Identifier: MIT */
/* point_colors.h - the colours of points in views that paint points, and their lines in the legend. */
#ifndef LAYERS_POINT_COLORS_H
#define LAYERS_POINT_COLORS_H

#include "legend.h"
#include "point_values.h"
#include "scene.h"

/* Set the colours of markers that show points of one leaf, by the view's point_color and its scale. A point with a
 * missing value has the plain colour of points. Under POINTS_BY_DENSITY the colours follow later: the draw room counts
 * the points of each pixel. `values` may be null. */
void color_points(const view *v, const point_values *values, const octree_node *leaf, scene_marker *markers,
                  size_t count);

/* Add the legend's lines about points. */
void add_point_legend(legend *l, const layer_source *in);

/* Return the colour kind of an LAS class, for theme_kind_color(). Similar classes share a kind; unknown classes have
 * kind 7, "other". class_kind_names holds the names of the kinds. */
unsigned kind_of_class(unsigned class);
extern const char *const class_kind_names[THEME_KINDS];

#endif
