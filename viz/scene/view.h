/* SPDX-License-Identifier: MIT */
/* view.h - how a scene is viewed: size, camera, layers, colours and filter. recording.json stores it. */
#ifndef SCENE_VIEW_H
#define SCENE_VIEW_H

#include "filter.h"

#include <stdbool.h>
#include <stdint.h>

/* The cameras: enumerator, name on the command line, description in --help. */
#define VIEW_CAMERA_MAP(X)                                                                                             \
    X(ISO, "iso", "from above, a three-quarter view, orthographic")                                                    \
    X(TOP, "top", "along -z, x to the right, y up, orthographic")                                                      \
    X(FRONT, "front", "along +y, x to the right, z up, orthographic")                                                  \
    X(SIDE, "side", "along -x, y to the right, z up, orthographic")                                                    \
    X(FOLLOW, "follow", "from behind and above the player, in perspective")                                            \
    X(ORBIT, "orbit", "circling the world by a fixed angle each tick, in perspective")

/* The meanings of a node's colour, with the same columns. */
#define VIEW_COLORING_MAP(X)                                                                                           \
    X(DEPTH, "depth", "its depth in the tree")                                                                         \
    X(OCCUPANCY, "occupancy",                                                                                          \
      "the number of points of a leaf relative to its capacity; of a foreign leaf, in powers of two")                  \
    X(PLAIN, "plain", "no meaning: all nodes have one colour")                                                         \
    X(KIND, "kind", "the kind of a foreign node, by its word")

/* The trees whose nodes are shown if the session has foreign nodes, with the same columns. */
#define VIEW_TREE_MAP(X)                                                                                               \
    X(AUTO, "auto", "foreign nodes from the first tick that has any; Octreel's nodes before")                          \
    X(OWN, "own", "only Octreel's nodes")                                                                              \
    X(FOREIGN, "foreign", "only foreign nodes")                                                                        \
    X(BOTH, "both", "both")

/* The meanings of a point's colour, with the same columns. */
#define VIEW_POINT_COLOR_MAP(ROW)                                                                                      \
    ROW(PLAIN, "plain", "no meaning: all points have one colour")                                                      \
    ROW(HEIGHT, "height", "its height, which is z")                                                                    \
    ROW(X, "x", "its x")                                                                                               \
    ROW(Y, "y", "its y")                                                                                               \
    ROW(Z, "z", "its z")                                                                                               \
    ROW(FILE, "file", "its own colour from its file or session")                                                       \
    ROW(LEAF, "leaf", "its leaf: alternately dark and light, in the point's own colour or that of height")             \
    ROW(DEPTH, "depth", "the depth of its leaf in the tree")                                                           \
    ROW(DENSITY, "density", "the number of points on its pixel")                                                       \
    ROW(CLASS, "class", "its class, as in LAS: ground, vegetation, buildings, water")                                  \
    ROW(INTENSITY, "intensity", "its intensity")                                                                       \
    ROW(ID, "id", "its id; in a cloud, its row in the file")

/* How points show their distance from the eye, with the same columns. */
#define VIEW_SHADE_MAP(X)                                                                                              \
    X(BANDS, "bands", "eight bands, darker with distance")                                                             \
    X(EDL, "edl", "eye-dome lighting: points behind nearer ones are darker, which shows surfaces")                     \
    X(NONE, "none", "not at all")

/* Where the diagram of the tree is drawn, with the same columns. */
#define VIEW_DIAGRAM_MAP(X)                                                                                            \
    X(NONE, "none", "nowhere")                                                                                         \
    X(BESIDE, "beside", "beside the space view, or below it if the picture is higher than wide")                       \
    X(ONLY, "only", "in place of the space view")

typedef enum view_camera {
#define VIEW_CAMERA_ENUM(name, ...) CAMERA_##name,
    VIEW_CAMERA_MAP(VIEW_CAMERA_ENUM)
#undef VIEW_CAMERA_ENUM
        CAMERA_COUNT
} view_camera;

typedef enum view_coloring {
#define VIEW_COLORING_ENUM(name, ...) COLORING_##name,
    VIEW_COLORING_MAP(VIEW_COLORING_ENUM)
#undef VIEW_COLORING_ENUM
        COLORING_COUNT
} view_coloring;

typedef enum view_tree {
#define VIEW_TREE_ENUM(name, ...) TREE_##name,
    VIEW_TREE_MAP(VIEW_TREE_ENUM)
#undef VIEW_TREE_ENUM
        TREE_COUNT
} view_tree;

typedef enum view_diagram {
#define VIEW_DIAGRAM_ENUM(name, ...) DIAGRAM_##name,
    VIEW_DIAGRAM_MAP(VIEW_DIAGRAM_ENUM)
#undef VIEW_DIAGRAM_ENUM
        DIAGRAM_COUNT
} view_diagram;

typedef enum view_point_color {
#define VIEW_POINT_COLOR_ENUM(name, ...) POINTS_BY_##name,
    VIEW_POINT_COLOR_MAP(VIEW_POINT_COLOR_ENUM)
#undef VIEW_POINT_COLOR_ENUM
        POINTS_BY_COUNT
} view_point_color;

typedef enum view_shade {
#define VIEW_SHADE_ENUM(name, ...) SHADE_##name,
    VIEW_SHADE_MAP(VIEW_SHADE_ENUM)
#undef VIEW_SHADE_ENUM
        SHADE_COUNT
} view_shade;

/* Ranges and spacing of the points shown at tick 0, for colours and sizes: point_scale.h. */
typedef struct point_scale {
    double low[3], high[3]; /* the range of nearly all positions */
    double ids[2];          /* the least and the greatest id */
    double intensities[2];  /* the range of nearly all intensities; only for POINTS_BY_INTENSITY */
    double spacing;         /* typical distance between neighbours on a surface, in world units; 0: unknown */
} point_scale;

/* The box that the camera frames. */
typedef enum view_fit {
    FIT_WORLD,
    FIT_POINTS, /* around the points shown at tick 0; camera_fit() replaces it by FIT_BOX */
    FIT_BOX,    /* view.focus, the result of FIT_POINTS */
} view_fit;

typedef struct view {
    int width, height; /* pixels */
    view_camera camera;
    view_fit fit;
    octree_box focus; /* the framed box, only with FIT_BOX */
    struct {
        bool given;
        double azimuth,
            elevation; /* degrees, from the center to the eye: azimuth from -y towards +x, elevation -90 to 90 */
    } look;            /* replaces the camera's own direction */
    struct {
        bool given;
        double place[3]; /* in world coordinates */
    } center;        /* the position that the camera looks at; replaces the middle of the framed box, or the player */
    double zoom;     /* magnification; 0 means 1 */
    unsigned layers; /* bit 1 << view_layer: layer.h */
    view_coloring coloring;
    view_point_color point_color;
    view_shade shade;
    struct {
        bool given;
        point_scale of;
    } point_scale; /* only if the view paints points */
    view_tree tree;
    view_diagram diagram; /* always of Octreel's tree, even if the space view shows foreign nodes */
    view_filter filter;
    bool labels;     /* write the paths of nodes on their boxes */
    bool closeup;    /* enlarge a small region in a part of the picture; compose/closeup_course.h chooses it */
    double lod;      /* pixels: leave out smaller boxes of nodes if an ancestor's box is drawn; 0: leave out none */
    int aa;          /* samples for each pixel on each axis: 1, 2 or 4; 0 means 1 */
    uint64_t budget; /* limits of a frame: boxes of nodes of each tree, points, and thousandths of this number of
                        velocity arrows; 0: no limits */
} view;

/* The longest side of a picture in samples: llvmpipe clamps longer ones. */
#define VIEW_MAX_SIDE 16384

/* The height of a picture, at most that of a 16:9 picture of its width. Sizes of lines and letters follow from it. */
int view_height_in_wide(const view *v);

/* The unit of the widths of lines and marks, in whole pixels so that edges stay sharp: 1 if view_height_in_wide() is
 * below 640, 2 from 640 on, 6 at 2160. */
int view_unit(const view *v);

/* Whether points are painted one by one in RGB colours, instead of as markers in colours of the theme. */
static inline bool view_paints_points(const view *v)
{
    return v->point_color != POINTS_BY_PLAIN || v->shade != SHADE_BANDS;
}

static inline double view_zoom(const view *v)
{
    return v->zoom > 0 ? v->zoom : 1;
}

/* Samples for each pixel on each axis. */
static inline int view_samples(const view *v)
{
    return v->aa > 1 ? v->aa : 1;
}

/* Whether the frames are RGB, because they need colours that the table of the theme lacks. */
static inline bool view_is_rgb(const view *v)
{
    return view_samples(v) > 1 || view_paints_points(v);
}

/* The name of a choice; null beyond the last. */
const char *view_camera_name(view_camera camera);
const char *view_coloring_name(view_coloring coloring);
const char *view_tree_name(view_tree tree);
const char *view_diagram_name(view_diagram diagram);
const char *view_point_color_name(view_point_color color);
const char *view_shade_name(view_shade shade);

/* The description of a choice; null beyond the last. */
const char *view_camera_words(view_camera camera);
const char *view_coloring_words(view_coloring coloring);
const char *view_tree_words(view_tree tree);
const char *view_diagram_words(view_diagram diagram);
const char *view_point_color_words(view_point_color color);
const char *view_shade_words(view_shade shade);

#endif
