/* SPDX-License-Identifier: MIT */
/* point_colors.c - colours points by position, id, leaf or the values in a point file, and explains the colours in the
 * legend. */
#include "point_colors.h"
#include "layer_type.h"
#include "octree/octree.h"

#include <stdio.h>

/* Return where a value lies between `low` (result 0) and `high` (result 1). All numbers are halved first, so that the
 * differences do not overflow. */
static double fraction_between(double value, double low, double high)
{
    const double whole = high / 2 - low / 2;
    return whole > 0 ? (value / 2 - low / 2) / whole : 0.5;
}

/* Return whether a leaf is a dark cell of the chessboard pattern. Of two leaves of the same depth that share a face,
 * one is dark and the other is not. */
static bool is_dark_cell(const octree_node *leaf)
{
    const unsigned octant = (unsigned)(leaf->address & 7);
    return (octant ^ octant >> 1 ^ octant >> 2) & 1;
}

#define DARK 180 /* brightness of the points in a dark leaf, in 256ths of their full brightness */

const char *const class_kind_names[THEME_KINDS] = {"unclassified", "ground", "vegetation",         "building",
                                                   "water",        "noise",  "road, rail, bridge", "other"};

unsigned find_class_color_kind(unsigned class)
{
    static const uint8_t kinds[] = {0, 0, 1, 2, 2, 2, 3, 5, 1, 4, 6, 6, 7, 7, 7, 7, 7, 6, 5};
    return class < sizeof kinds ? kinds[class] : 7;
}

/* How the points of one leaf are coloured. */
typedef struct painting {
    /* What the colour shows. Never POINTS_BY_LEAF, which colours points as POINTS_BY_FILE or POINTS_BY_HEIGHT does. */
    view_point_color by;
    const point_scale *scale;
    const point_values *values;
    theme_color plain; /* the colour of points whose value is missing */
} painting;

/* Return the axis whose coordinate decides the colour: 0, 1 or 2. The height is the coordinate on axis 2. */
static int axis_of_coloring(view_point_color by)
{
    return by == POINTS_BY_X ? 0 : by == POINTS_BY_Y ? 1 : 2;
}

static theme_color color_of_marker(const painting *p, const scene_marker *m)
{
    const point_scale *scale = p->scale;
    const int axis = axis_of_coloring(p->by);
    point_value value;
    switch (p->by) {
    case POINTS_BY_FILE:
        value = point_values_get(p->values, m->id);
        return value.has[POINT_COLOR] ? (theme_color){value.color[0], value.color[1], value.color[2]} : p->plain;
    case POINTS_BY_CLASS:
        value = point_values_get(p->values, m->id);
        return value.has[POINT_CLASS] ? theme_kind_color(find_class_color_kind(value.class)) : p->plain;
    case POINTS_BY_INTENSITY:
        value = point_values_get(p->values, m->id);
        if (!value.has[POINT_INTENSITY])
            return p->plain;
        return theme_ramp_color(
            fraction_between((double)value.intensity, scale->intensities[0], scale->intensities[1]));
    case POINTS_BY_ID:
        return theme_ramp_color(fraction_between((double)m->id, scale->ids[0], scale->ids[1]));
    case POINTS_BY_X:
    case POINTS_BY_Y:
    case POINTS_BY_Z:
    case POINTS_BY_HEIGHT:
        return theme_ramp_color(fraction_between(m->at[axis], scale->low[axis], scale->high[axis]));
    default:
        return p->plain;
    }
}

void color_points(const view *v, const point_values *values, const octree_node *leaf, scene_marker *markers,
                  size_t count)
{
    const bool by_leaf = v->point_color == POINTS_BY_LEAF, colored = point_values_kinds(values) >> POINT_COLOR & 1;
    const theme_role role = v->point_color == POINTS_BY_DEPTH ? theme_node_role(leaf->depth) : ROLE_POINT;
    const int light = by_leaf && is_dark_cell(leaf) ? DARK : 256;
    const painting p = {.by = !by_leaf  ? v->point_color
                              : colored ? POINTS_BY_FILE
                                        : POINTS_BY_HEIGHT,
                        .scale = &v->point_scale.of,
                        .values = values,
                        .plain = theme_color_at(theme_color_index(role, 0))};
    for (size_t i = 0; i < count; i++)
        markers[i].color = theme_fade_color(color_of_marker(&p, &markers[i]), light);
}

/* ---- The legend --------------------------------------------------------------------------------------------- */

/* Add a legend line for each kind of LAS class that occurs among the points. */
static void add_class_legend(legend *l, const point_values *values)
{
    unsigned kinds = 0; /* bit i is set if a class of kind i occurs among the points */
    for (size_t row = 0; row < values->count; row++)
        if (values->rows[row].has[POINT_CLASS])
            kinds |= 1u << find_class_color_kind(values->rows[row].class);
    for (unsigned kind = 0; kind < THEME_KINDS; kind++)
        if (kinds >> kind & 1)
            legend_add(l, SIGN_SWATCH, "%s", class_kind_names[kind])->color = theme_kind_color(kind);
}

static legend_scale make_color_scale(const point_scale *s, view_point_color by)
{
    const int axis = axis_of_coloring(by);
    switch (by) {
    case POINTS_BY_ID:
        return (legend_scale){s->ids[0], s->ids[1], .pointed = false};
    case POINTS_BY_INTENSITY:
        return (legend_scale){s->intensities[0], s->intensities[1], .pointed = true};
    case POINTS_BY_DENSITY:
        return (legend_scale){1, THEME_MOST_DENSITY, .doubling = true};
    default:
        return (legend_scale){s->low[axis], s->high[axis], .pointed = true};
    }
}

static void add_leaf_legend(legend *l, const layer_source *in)
{
    legend_add(l, SIGN_CHECKS, "leaves of points");
    if (point_values_kinds(in->values) >> POINT_COLOR & 1)
        legend_add(l, SIGN_DOT, "points, as in the file");
    else
        legend_add(l, SIGN_DOT, "points, by height");
}

void add_point_legend(legend *l, const layer_source *in)
{
    const view *v = &l->scene->view;
    const unsigned has = point_values_kinds(in->values);
    const bool colored = has >> POINT_COLOR & 1;
    switch (v->point_color) {
    case POINTS_BY_PLAIN:
        legend_add(l, SIGN_DOT, "point");
        return;
    case POINTS_BY_FILE:
        legend_add(l, SIGN_DOT, colored ? "points, as in the file" : "points, without colours");
        return;
    case POINTS_BY_CLASS:
        if (has >> POINT_CLASS & 1)
            add_class_legend(l, in->values);
        else
            legend_add(l, SIGN_DOT, "points, without classes");
        return;
    case POINTS_BY_DEPTH:
        legend_add_depths(l, "points, leaf depth", find_depth_of_tree(in));
        return;
    case POINTS_BY_LEAF:
        add_leaf_legend(l, in);
        if (colored)
            return;
        break;
    case POINTS_BY_DENSITY:
        legend_add(l, SIGN_DOT, "points in a pixel");
        break;
    default:
        if (v->point_color == POINTS_BY_INTENSITY && !(has >> POINT_INTENSITY & 1)) {
            legend_add(l, SIGN_DOT, "points, no intensities");
            return;
        }
        legend_add(l, SIGN_DOT, "points, by %s", view_point_color_name(v->point_color));
    }
    /* Without a scale no point is shown, so the legend needs no colour bar. */
    if (v->point_scale.given || v->point_color == POINTS_BY_DENSITY)
        legend_add_scale(l, make_color_scale(&v->point_scale.of, v->point_color));
}
