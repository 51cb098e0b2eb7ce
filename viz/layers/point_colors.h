/* SPDX-License-Identifier: MIT */
/* point_colors.h - the colours of points in views that colour points, and the legend lines that explain them. */
#ifndef LAYERS_POINT_COLORS_H
#define LAYERS_POINT_COLORS_H

#include "legend.h"
#include "point_values.h"
#include "scene.h"

/* Set the colours of markers, by the view's point_color and its scale. All markers must show points of the same leaf. A
 * point whose value is missing gets the plain colour of points. Under POINTS_BY_DENSITY the colours are set later, when
 * viz/draw counts the points in each pixel. `values` may be null. */
void color_points(const view *v, const point_values *values, const octree_node *leaf, scene_marker *markers,
                  size_t count);

/* Add the legend's lines that explain the colours of points. */
void add_point_legend(legend *l, const layer_source *in);

/* Return the kind of an LAS class, for theme_kind_color(). Similar classes have the same kind; unknown classes have
 * kind 7, "other". The array class_kind_names has the names of the kinds. */
unsigned find_class_color_kind(unsigned class);
extern const char *const class_kind_names[THEME_KINDS];

#endif
