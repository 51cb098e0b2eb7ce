/* SPDX-License-Identifier: MIT */
#include "point_colors.h"
#include "layer_type.h"

#include <stdio.h>

/* The axis whose coordinate is the colour; -1: it is none. */
static int axis_of(view_point_color color)
{
    switch (color) {
    case POINTS_BY_X:
        return 0;
    case POINTS_BY_Y:
        return 1;
    case POINTS_BY_HEIGHT:
    case POINTS_BY_Z:
        return 2;
    default:
        return -1;
    }
}

/* Where a value lies between two others, without overflow. */
static double part_of(double value, double low, double high)
{
    const double whole = high / 2 - low / 2;
    return whole > 0 ? (value / 2 - low / 2) / whole : 0.5;
}

/* Leaves that share a face differ, where they are of one depth: cells are dark and light as on a chessboard. */
static bool is_dark(const octree_node *leaf)
{
    const unsigned octant = (unsigned)(leaf->address & 7);
    return (octant ^ octant >> 1 ^ octant >> 2) & 1;
}

#define DARK 180 /* 256ths */

/* The colour of an amount, of one point. */
static theme_color color_of(const view *v, const scene_marker *m)
{
    const point_scale *scale = &v->point_scale.of;
    const int axis = v->point_color == POINTS_BY_LEAF ? 2 : axis_of(v->point_color);
    if (v->point_color == POINTS_BY_ID)
        return theme_ramp(part_of((double)m->id, scale->ids[0], scale->ids[1]));
    return theme_ramp(part_of(m->at[axis], scale->low[axis], scale->high[axis]));
}

void color_points(const view *v, const octree_node *leaf, scene_marker *markers, size_t count)
{
    const bool by_depth = v->point_color == POINTS_BY_DEPTH;
    const bool by_amount = axis_of(v->point_color) >= 0 || v->point_color == POINTS_BY_ID;
    const int light = v->point_color == POINTS_BY_LEAF && is_dark(leaf) ? DARK : 256;
    const theme_color all = theme_color_at(theme_index(by_depth ? theme_node_role(leaf->depth) : ROLE_POINT, 0));
    for (size_t i = 0; i < count; i++)
        markers[i].color =
            by_amount || v->point_color == POINTS_BY_LEAF ? theme_fade(color_of(v, &markers[i]), light) : all;
}
