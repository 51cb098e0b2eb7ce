/* SPDX-License-Identifier: MIT */
/* point_colors.c - colours points by position, id, leaf or file values, and explains the colours in the legend. */
#include "point_colors.h"
#include "layer_type.h"
#include "octree/octree.h"

#include <stdio.h>

/* Return the position of a value between low (0) and high (1). Halving first avoids overflow. */
static double fraction_between(double value, double low, double high)
{
    const double whole = high / 2 - low / 2;
    return whole > 0 ? (value / 2 - low / 2) / whole : 0.5;
}

/* Whether a leaf is a dark cell of the chessboard pattern. Two leaves of the same depth that share a face differ. */
static bool is_dark_cell(const octree_node *leaf)
{
    const unsigned octant = (unsigned)(leaf->address & 7);
    return (octant ^ octant >> 1 ^ octant >> 2) & 1;
}

#define DARK 180 /* brightness of a dark leaf's points, in 256ths */

const char *const class_kind_names[THEME_KINDS] = {"unclassified", "ground", "vegetation",         "building",
                                                   "water",        "noise",  "road, rail, bridge", "other"};

unsigned kind_of_class(unsigned class)
{
    static const uint8_t kinds[] = {0, 0, 1, 2, 2, 2, 3, 5, 1, 4, 6, 6, 7, 7, 7, 7, 7, 6, 5};
    return class < sizeof kinds ? kinds[class] : 7;
}

/* How the points of one leaf are painted. */
typedef struct painting {
    const view *view;
    const point_values *values;
    theme_color plain; /* the colour of points with a missing value */
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
        return theme_ramp(fraction_between((double)value.intensity, scale->intensities[0], scale->intensities[1]));
    default:
        return value.has[POINT_COLOR] ? (theme_color){value.color[0], value.color[1], value.color[2]} : p->plain;
    }
}

static theme_color color_on_axis(const painting *p, const scene_marker *m, int axis)
{
    const point_scale *scale = &p->view->point_scale.of;
    return theme_ramp(fraction_between(m->at[axis], scale->low[axis], scale->high[axis]));
}

static theme_color color_of_marker(const painting *p, const scene_marker *m)
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
        return point_values_kinds(p->values) >> POINT_COLOR & 1 ? color_of_value(p, m->id) : color_on_axis(p, m, 2);
    case POINTS_BY_ID:
        return theme_ramp(fraction_between((double)m->id, scale->ids[0], scale->ids[1]));
    default:
        return p->plain;
    }
}

void color_points(const view *v, const point_values *values, const octree_node *leaf, scene_marker *markers,
                  size_t count)
{
    const theme_role role = v->point_color == POINTS_BY_DEPTH ? theme_node_role(leaf->depth) : ROLE_POINT;
    const painting p = {v, values, theme_color_at(theme_index(role, 0))};
    const int light = v->point_color == POINTS_BY_LEAF && is_dark_cell(leaf) ? DARK : 256;
    for (size_t i = 0; i < count; i++)
        markers[i].color = theme_fade(color_of_marker(&p, &markers[i]), light);
}

/* ---- The legend --------------------------------------------------------------------------------------------- */

/* Return the class kinds of all points: bit i for kind i. */
static unsigned class_kinds_in(const point_values *values)
{
    unsigned kinds = 0;
    for (size_t row = 0; values && row < values->count; row++)
        if (values->rows[row].has[POINT_CLASS])
            kinds |= 1u << kind_of_class(values->rows[row].class);
    return kinds;
}

static void add_class_legend(legend *l, const point_values *values)
{
    const unsigned kinds = class_kinds_in(values);
    for (unsigned kind = 0; kind < THEME_KINDS; kind++)
        if (kinds >> kind & 1)
            legend_add(l, SIGN_SWATCH, "%s", class_kind_names[kind])->color = theme_kind(kind);
}

static legend_scale scale_of(const point_scale *s, view_point_color color)
{
    switch (color) {
    case POINTS_BY_X:
        return (legend_scale){s->low[0], s->high[0], .pointed = true};
    case POINTS_BY_Y:
        return (legend_scale){s->low[1], s->high[1], .pointed = true};
    case POINTS_BY_ID:
        return (legend_scale){s->ids[0], s->ids[1], .pointed = false};
    case POINTS_BY_INTENSITY:
        return (legend_scale){s->intensities[0], s->intensities[1], .pointed = true};
    case POINTS_BY_DENSITY:
        return (legend_scale){1, THEME_MOST_DENSITY, .doubling = true};
    default:
        return (legend_scale){s->low[2], s->high[2], .pointed = true};
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
        legend_add_depths(l, "points, leaf depth", octree_definition(in->tree).max_depth);
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
    if (v->point_scale.given || v->point_color == POINTS_BY_DENSITY) /* without a scale no point is shown */
        legend_add_scale(l, scale_of(&v->point_scale.of, v->point_color));
}
