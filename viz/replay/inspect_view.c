/* SPDX-License-Identifier: MIT */
/* inspect_view.c - chooses colours and shading for the points of a cloud's picture. */
#include "inspect_view.h"
#include "layer.h"
#include "layout.h"
#include "octree/octree.h"
#include "point_scale.h"

#include <stdio.h>
#include <string.h>

static bool has_colors(const inspection *made)
{
    return point_values_kinds(&made->values) >> POINT_COLOR & 1;
}

/* Returns the part of the picture in which the tree is drawn. */
static camera_window find_space_window(const inspection *made, const view *v)
{
    const octree_box world = octree_definition(made->tree).world;
    scene empty = {0};
    scene_set_view(&empty, v);
    return layout_camera_area(&empty, &world);
}

/* Minimum number of pixels per leaf for colours by leaf; with fewer pixels, these colours look like noise. */
#define LEAF_PIXELS 32

/* Returns true if points should be coloured by leaf: the points hide the boxes of the nodes, and the leaves are large
 * enough on the screen. Writes the reason for the choice to *said. */
static bool prefers_leaf_colors(const inspection *made, const view *v, const char **said)
{
    const camera_window w = find_space_window(made, v);
    const double pixels = w.width * w.height;
    octree_stats stats;
    *said = "";
    if ((double)octree_count(made->tree) <= pixels || octree_statistics(made->tree, &stats) != OCTREE_OK)
        return false;
    const bool seen = (double)stats.leaves * LEAF_PIXELS <= pixels;
    *said = seen ? ", because there are more points than pixels"
                 : "; leaves are too small to see: a larger --capacity makes them larger";
    return seen;
}

/* Returns true if neighbouring points touch each other on the screen and so form surfaces. The test uses the camera of
 * tick 0. */
static bool points_form_surfaces(const inspection *made, const view *v)
{
    const octree_box world = octree_definition(made->tree).world;
    const camera c = camera_make(v, find_space_window(made, v), &world, NULL, 0);
    const double apart = point_scale_length_in_pixels(&c, v->point_scale.of.spacing) / (c.perspective ? c.distance : 1);
    return v->point_scale.given && apart > 0 && apart <= POINT_WIDEST * view_pixels_per_unit(v);
}

#define COLORS_TEXT 80

/* Write how points are coloured, such as "points by height (--color-points)". Returns `text`. */
static const char *describe_colors(const inspection *made, const view *v, char text[COLORS_TEXT])
{
    const char *lacks = point_scale_missing_value(v, &made->values), *option = "(--color-points)";
    if (lacks)
        snprintf(text, COLORS_TEXT, "points in one colour, because none has %s %s", lacks, option);
    else if (v->point_color == POINTS_BY_FILE)
        snprintf(text, COLORS_TEXT, "points in their colours %s", option);
    else
        snprintf(text, COLORS_TEXT, "points by %s %s", view_point_color_name(v->point_color), option);
    return text;
}

bool inspect_choose_view(const inspection *made, bool color_given, bool shade_given, view *v, char said[INSPECT_CHOICE],
                         octreel_error *error)
{
    const char *why = "", *lit = "";
    *said = 0;
    if (v->diagram == DIAGRAM_ONLY || !view_shows_layer(v, LAYER_POINTS) ||
        (color_given && v->point_color == POINTS_BY_PLAIN))
        return true;
    if (!color_given)
        v->point_color = prefers_leaf_colors(made, v, &why) ? POINTS_BY_LEAF
                         : has_colors(made)                 ? POINTS_BY_FILE
                                                            : POINTS_BY_HEIGHT;
    view fitted = *v;
    camera_fit_points(&fitted, made->tree);
    if (!point_scale_compute(&fitted, made->tree, &made->values))
        return error_no_memory(error);
    v->point_scale = fitted.point_scale; /* keep the fitted scale, because fitting it costs a walk over all points */
    if (!shade_given && points_form_surfaces(made, &fitted)) {
        v->shade = SHADE_EDL;
        lit = ", lit by eye-dome lighting (--shade)";
    }
    if (!(color_given && shade_given)) {
        char colors[COLORS_TEXT];
        const bool leaves = v->point_color == POINTS_BY_LEAF;
        snprintf(said, INSPECT_CHOICE, "%s%s%s%s", describe_colors(made, v, colors), leaves ? why : "", lit,
                 leaves ? "" : why);
    }
    return true;
}
