/* SPDX-License-Identifier: MIT */
/* view.h - how a scene is viewed: size, camera, layers, colours and filter. recording.json stores the view. */
#ifndef SCENE_VIEW_H
#define SCENE_VIEW_H

#include "filter.h"

#include <stdbool.h>
#include <stdint.h>

/* The cameras. Columns: value, name on the command line, description in --help. */
#define VIEW_CAMERA_MAP(X)                                                                                             \
    X(CAMERA_ISO, "iso", "from above, a three-quarter view, orthographic")                                             \
    X(CAMERA_TOP, "top", "along -z, x to the right, y up, orthographic")                                               \
    X(CAMERA_FRONT, "front", "along +y, x to the right, z up, orthographic")                                           \
    X(CAMERA_SIDE, "side", "along -x, y to the right, z up, orthographic")                                             \
    X(CAMERA_FOLLOW, "follow", "from behind and above the player, in perspective")                                     \
    X(CAMERA_ORBIT, "orbit", "circling the world by a fixed angle each tick, in perspective")

/* What a node's colour means. Columns as in VIEW_CAMERA_MAP. */
#define VIEW_COLORING_MAP(X)                                                                                           \
    X(COLORING_DEPTH, "depth", "its depth in the tree")                                                                \
    X(COLORING_OCCUPANCY, "occupancy",                                                                                 \
      "the number of points of a leaf relative to its capacity; of a foreign leaf, in powers of two")                  \
    X(COLORING_PLAIN, "plain", "no meaning: all nodes have one colour")                                                \
    X(COLORING_KIND, "kind", "the kind of a foreign node, by its word")

/* The trees whose nodes are shown if the session has foreign nodes. Columns as in VIEW_CAMERA_MAP. */
#define VIEW_TREE_MAP(X)                                                                                               \
    X(TREE_AUTO, "auto", "foreign nodes from the first tick that has any; Octreel's nodes before")                     \
    X(TREE_OWN, "own", "only Octreel's nodes")                                                                         \
    X(TREE_FOREIGN, "foreign", "only foreign nodes")                                                                   \
    X(TREE_BOTH, "both", "both")

/* What a point's colour means. Columns as in VIEW_CAMERA_MAP. */
#define VIEW_POINT_COLOR_MAP(X)                                                                                        \
    X(POINTS_BY_PLAIN, "plain", "no meaning: all points have one colour")                                              \
    X(POINTS_BY_HEIGHT, "height", "its height, which is z")                                                            \
    X(POINTS_BY_X, "x", "its x")                                                                                       \
    X(POINTS_BY_Y, "y", "its y")                                                                                       \
    X(POINTS_BY_Z, "z", "its z")                                                                                       \
    X(POINTS_BY_FILE, "file", "its own colour from its file or session")                                               \
    X(POINTS_BY_LEAF, "leaf", "its leaf: alternately dark and light, in the point's own colour or that of height")     \
    X(POINTS_BY_DEPTH, "depth", "the depth of its leaf in the tree")                                                   \
    X(POINTS_BY_DENSITY, "density", "the number of points on its pixel")                                               \
    X(POINTS_BY_CLASS, "class", "its class, as in LAS: ground, vegetation, buildings, water")                          \
    X(POINTS_BY_INTENSITY, "intensity", "its intensity")                                                               \
    X(POINTS_BY_ID, "id", "its id; in a cloud, its row in the file")

/* How points show their distance from the eye. Columns as in VIEW_CAMERA_MAP. */
#define VIEW_SHADE_MAP(X)                                                                                              \
    X(SHADE_BANDS, "bands", "eight bands, darker with distance")                                                       \
    X(SHADE_EDL, "edl", "eye-dome lighting: points behind nearer ones are darker, which shows surfaces")               \
    X(SHADE_NONE, "none", "not at all")

/* Where the diagram of the tree is drawn. Columns as in VIEW_CAMERA_MAP. */
#define VIEW_DIAGRAM_MAP(X)                                                                                            \
    X(DIAGRAM_NONE, "none", "nowhere")                                                                                 \
    X(DIAGRAM_BESIDE, "beside", "beside the space view, or below it if the picture is higher than wide")               \
    X(DIAGRAM_ONLY, "only", "in place of the space view")

#define VIEW_VALUE(value, ...) value,
typedef enum view_camera { VIEW_CAMERA_MAP(VIEW_VALUE) CAMERA_COUNT } view_camera;
typedef enum view_coloring { VIEW_COLORING_MAP(VIEW_VALUE) COLORING_COUNT } view_coloring;
typedef enum view_tree { VIEW_TREE_MAP(VIEW_VALUE) TREE_COUNT } view_tree;
typedef enum view_point_color { VIEW_POINT_COLOR_MAP(VIEW_VALUE) POINTS_BY_COUNT } view_point_color;
typedef enum view_shade { VIEW_SHADE_MAP(VIEW_VALUE) SHADE_COUNT } view_shade;
typedef enum view_diagram { VIEW_DIAGRAM_MAP(VIEW_VALUE) DIAGRAM_COUNT } view_diagram;
#undef VIEW_VALUE

/* The ranges and the spacing of the points shown at tick 0. They determine colours and sizes of points:
 * point_scale.h. */
typedef struct point_scale {
    double low[3], high[3]; /* the range of positions, outliers cut off */
    double ids[2];          /* the least and the greatest id */
    double intensities[2];  /* the range of intensities, outliers cut off; only for POINTS_BY_INTENSITY */
    double spacing;         /* the typical distance between neighbouring points, in world units; 0: unknown */
} point_scale;

/* The box that the camera frames. */
typedef enum view_fit {
    FIT_WORLD,
    FIT_POINTS, /* the box of the points shown at tick 0; camera_fit_points() replaces this value by FIT_BOX */
    FIT_BOX,    /* the box view.focus, which camera_fit_points() computes for FIT_POINTS */
} view_fit;

typedef struct view {
    int width, height; /* the size of the picture in pixels */
    view_camera camera;
    view_fit fit;
    octree_box focus; /* the framed box if `fit` is FIT_BOX */
    struct {
        bool given;
        /* in degrees, from the center to the eye: azimuth from -y towards +x, elevation -90 to 90 */
        double azimuth, elevation;
    } look; /* if given, replaces the direction of `camera` */
    struct {
        bool given;
        double place[3]; /* the position in world coordinates */
    } center;        /* if given, the camera looks at `place` instead of the middle of the framed box or the player */
    double zoom;     /* the magnification */
    unsigned layers; /* the layers that are shown, as bits 1 << view_layer: layer.h */
    view_coloring coloring;
    view_point_color point_color;
    view_shade shade;
    struct {
        bool given;
        point_scale of;
    } point_scale; /* used only if the view paints points */
    view_tree tree;
    view_diagram diagram; /* it shows Octreel's tree even if the space view shows foreign nodes */
    view_filter filter;
    bool labels;     /* write the paths of nodes on their boxes */
    bool closeup;    /* enlarge a small region in a part of the picture; compose/closeup_course.h chooses the region */
    double lod;      /* in pixels: leave out smaller boxes of nodes if an ancestor's box is drawn; 0: leave out none */
    int aa;          /* samples per pixel on each axis: 1, 2 or 4 */
    uint64_t budget; /* the most boxes of nodes (for each tree) and the most points in a frame; a thousandth of it is
                        the most velocity arrows; 0: no limits */
} view;

/* The longest side of a picture in samples: llvmpipe clamps longer sides. */
#define VIEW_MAX_SIDE 16384

/* Returns the height of a picture, or the height of a 16:9 picture of the same width if that is less. The sizes of
 * lines and letters depend on it. */
int view_height_at_16_9(const view *v);

/* Returns the unit of the widths of lines and markers, in pixels: 1 if view_height_at_16_9() is below 640, 2 from 640
 * on, 6 at 2160. It is a whole number, so that edges stay sharp. */
int view_pixels_per_unit(const view *v);

/* True if points are painted one by one in RGB colours. Otherwise they are markers in colours of the theme. */
static inline bool view_paints_points(const view *v)
{
    return v->point_color != POINTS_BY_PLAIN || v->shade != SHADE_BANDS;
}

/* True if frames are RGB, because they need colours that are not in the theme's table. */
static inline bool view_is_rgb(const view *v)
{
    return v->aa > 1 || view_paints_points(v);
}

/* Returns the name or the description of the n-th value of an enumeration; null if n is beyond the last value. */
typedef const char *view_choice_text(int n);
view_choice_text view_camera_name, view_coloring_name, view_tree_name, view_diagram_name, view_point_color_name,
    view_shade_name, view_camera_words, view_coloring_words, view_tree_words, view_diagram_words,
    view_point_color_words, view_shade_words;

#endif
