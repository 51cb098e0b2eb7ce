/* SPDX-License-Identifier: MIT */
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

/* Where the tree is drawn. */
static camera_window space_of(const inspection *made, const view *v)
{
    const octree_box world = octree_definition(made->tree).world;
    scene empty = {0};
    scene_set_view(&empty, v);
    return layout_camera(&empty, &world);
}

#define LEAF_PIXELS 32 /* of the space view for each leaf: with fewer, dark and light leaves are noise */

/* Whether the points hide the boxes of nodes and their leaves are to be shown instead; *said is why, or why not. */
static bool choose_leaves(const inspection *made, const view *v, const char **said)
{
    const camera_window w = space_of(made, v);
    const double pixels = w.width * w.height;
    octree_stats stats;
    *said = "";
    if ((double)octree_count(made->tree) <= pixels || octree_statistics(made->tree, &stats) != OCTREE_OK)
        return false;
    const bool seen = (double)stats.leaves * LEAF_PIXELS <= pixels;
    *said = seen ? ", since there are more of them than pixels"
                 : "; leaves are too small to see, and larger with a larger --capacity";
    return seen;
}

/* Whether the points, as they are seen from the camera of tick 0, are near enough to each other. */
static bool close_surfaces(const inspection *made, const view *v)
{
    const octree_box world = octree_definition(made->tree).world;
    double center[3];
    scene_box_middle(v->fit == FIT_BOX ? &v->focus : &world, center);
    const camera c = camera_make(v, space_of(made, v), &world, center, 0);
    const double apart = point_scale_pixels(&c, v->point_scale.of.spacing) / (c.perspective ? c.distance : 1);
    return v->point_scale.given && apart > 0 && apart <= POINT_WIDEST * view_unit(v);
}

#define COLORS_TEXT 60

/* "points by height (--color-points)". Returns `text`. */
static const char *say_colors(const inspection *made, const view *v, char text[COLORS_TEXT])
{
    const char *lacks = point_scale_lacks(v, &made->values), *option = "(--color-points)";
    if (lacks)
        snprintf(text, COLORS_TEXT, "points alike, as none has %s %s", lacks, option);
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
    if (v->diagram == DIAGRAM_ONLY || !view_shows(v, LAYER_POINTS) ||
        (color_given && v->point_color == POINTS_BY_PLAIN))
        return true;
    if (!color_given)
        v->point_color = choose_leaves(made, v, &why) ? POINTS_BY_LEAF
                         : has_colors(made)           ? POINTS_BY_FILE
                                                      : POINTS_BY_HEIGHT;
    view fitted = *v;
    camera_fit(&fitted, made->tree);
    if (!point_scale_fit(&fitted, made->tree, &made->values))
        return error_no_memory(error);
    v->point_scale = fitted.point_scale; /* it costs a walk over all points */
    if (!shade_given && close_surfaces(made, &fitted)) {
        v->shade = SHADE_EDL;
        lit = ", lit by eye-dome lighting (--shade)";
    }
    if (!(color_given && shade_given)) {
        char colors[COLORS_TEXT];
        const bool leaves = v->point_color == POINTS_BY_LEAF;
        snprintf(said, INSPECT_CHOICE, "%s%s%s%s", say_colors(made, v, colors), leaves ? why : "", lit,
                 leaves ? "" : why);
    }
    return true;
}
