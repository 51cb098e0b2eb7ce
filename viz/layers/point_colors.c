/* SPDX-License-Identifier: MIT */
#include "point_colors.h"
#include "layer_type.h"

#include <stdio.h>

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

const char *const class_kind_names[THEME_KINDS] = {"unclassified", "ground", "vegetation",         "building",
                                                   "water",        "noise",  "road, rail, bridge", "other"};

unsigned kind_of_class(unsigned class)
{
    static const uint8_t kinds[] = {0, 0, 1, 2, 2, 2, 3, 5, 1, 4, 6, 6, 7, 7, 7, 7, 7, 6, 5};
    return class < sizeof kinds ? kinds[class] : 7;
}

/* How the points of one leaf are coloured. */
typedef struct painting {
    const view *view;
    const point_values *values;
    theme_color plain; /* of points that lack the value */
} painting;

static theme_color color_of_value(const painting *p, uint64_t id)
{
    const point_scale *scale = &p->view->point_scale.of;
    const point_value value = point_values_get(p->values, id);
    switch (p->view->point_color) {
    case POINTS_BY_CLASS:
        return value.has[POINT_CLASS] ? theme_kind(kind_of_class(value.class)) : p->plain;
    case POINTS_BY_INTENSITY:
        if (!value.has[POINT_INTENSITY])
            return p->plain;
        return theme_ramp(part_of((double)value.intensity, scale->intensities[0], scale->intensities[1]));
    default:
        return value.has[POINT_COLOR] ? (theme_color){value.color[0], value.color[1], value.color[2]} : p->plain;
    }
}

static theme_color color_on_axis(const painting *p, const scene_marker *m, int axis)
{
    const point_scale *scale = &p->view->point_scale.of;
    return theme_ramp(part_of(m->at[axis], scale->low[axis], scale->high[axis]));
}

static theme_color color_of(const painting *p, const scene_marker *m)
{
    const point_scale *scale = &p->view->point_scale.of;
    switch (p->view->point_color) {
    case POINTS_BY_FILE:
    case POINTS_BY_CLASS:
    case POINTS_BY_INTENSITY:
        return color_of_value(p, m->id);
    case POINTS_BY_X:
        return color_on_axis(p, m, 0);
    case POINTS_BY_Y:
        return color_on_axis(p, m, 1);
    case POINTS_BY_HEIGHT:
    case POINTS_BY_Z:
        return color_on_axis(p, m, 2);
    case POINTS_BY_LEAF:
        return p->values && p->values->colors ? color_of_value(p, m->id) : color_on_axis(p, m, 2);
    case POINTS_BY_ID:
        return theme_ramp(part_of((double)m->id, scale->ids[0], scale->ids[1]));
    default:
        return p->plain;
    }
}

void color_points(const view *v, const point_values *values, const octree_node *leaf, scene_marker *markers,
                  size_t count)
{
    const theme_role role = v->point_color == POINTS_BY_DEPTH ? theme_node_role(leaf->depth) : ROLE_POINT;
    const painting p = {v, values, theme_color_at(theme_index(role, 0))};
    const int light = v->point_color == POINTS_BY_LEAF && is_dark(leaf) ? DARK : 256;
    for (size_t i = 0; i < count; i++)
        markers[i].color = theme_fade(color_of(&p, &markers[i]), light);
}
