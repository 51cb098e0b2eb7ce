/* SPDX-License-Identifier: MIT */
/* view.c - the units of a view, and the names of the values of its enumerations; see view.h. */
#include "view.h"

#include <stddef.h>

int view_height_at_16_9(const view *v)
{
    const int wide = v->width / 16 * 9;
    if (v->suited_height)
        return v->suited_height;
    return v->height < wide ? v->height : wide;
}

int view_pixels_per_unit(const view *v)
{
    const int height = view_height_at_16_9(v);
    return height < 640 ? 1 : (height + 180) / 360;
}

/* Define the functions TYPE_name() and TYPE_words(), which return the name and the description of a value. `map` is a
 * map of view.h. */
#define VIEW_ROW(name, ...) {__VA_ARGS__},
#define VIEW_NAMES(type, map, count)                                                                                   \
    static const char *const type##_rows[count][2] = {map(VIEW_ROW)};                                                  \
    const char *type##_name(int n)                                                                                     \
    {                                                                                                                  \
        return (unsigned)n < count ? type##_rows[n][0] : NULL;                                                         \
    }                                                                                                                  \
    const char *type##_words(int n)                                                                                    \
    {                                                                                                                  \
        return (unsigned)n < count ? type##_rows[n][1] : NULL;                                                         \
    }

VIEW_NAMES(view_camera, VIEW_CAMERA_MAP, CAMERA_COUNT)
VIEW_NAMES(view_coloring, VIEW_COLORING_MAP, COLORING_COUNT)
VIEW_NAMES(view_point_color, VIEW_POINT_COLOR_MAP, POINTS_BY_COUNT)
VIEW_NAMES(view_shade, VIEW_SHADE_MAP, SHADE_COUNT)
VIEW_NAMES(view_tree, VIEW_TREE_MAP, TREE_COUNT)
VIEW_NAMES(view_diagram, VIEW_DIAGRAM_MAP, DIAGRAM_COUNT)
