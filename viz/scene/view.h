/* SPDX-License-Identifier: MIT */
/* view.h - how a scene is viewed: size, camera, layers, colours and filter. recording.json stores it. */
#ifndef SCENE_VIEW_H
#define SCENE_VIEW_H

#include "filter.h"

#include <stdbool.h>
#include <stdint.h>

/* The cameras: value, name on the command line, description in --help. */
#define VIEW_CAMERA_MAP(X)                                                                                             \
    X(CAMERA_ISO, "iso", "from above, a three-quarter view, orthographic")                                             \
    X(CAMERA_TOP, "top", "along -z, x to the right, y up, orthographic")                                               \
    X(CAMERA_FRONT, "front", "along +y, x to the right, z up, orthographic")                                           \
    X(CAMERA_SIDE, "side", "along -x, y to the right, z up, orthographic")                                             \
    X(CAMERA_FOLLOW, "follow", "from behind and above the player, in perspective")                                     \
    X(CAMERA_ORBIT, "orbit", "circling the world by a fixed angle each tick, in perspective")

/* The meanings of a node's colour, with the same columns. */
#define VIEW_COLORING_MAP(X)                                                                                           \
    X(COLORING_DEPTH, "depth", "its depth in the tree")                                                                \
    X(COLORING_OCCUPANCY, "occupancy",                                                                                 \
      "the number of points of a leaf relative to its capacity; of a foreign leaf, in powers of two")                  \
    X(COLORING_PLAIN, "plain", "no meaning: all nodes have one colour")                                                \
    X(COLORING_KIND, "kind", "the kind of a foreign node, by its word")

/* The trees whose nodes are shown if the session has foreign nodes, with the same columns. */
#define VIEW_TREE_MAP(X)                                                                                               \
    X(TREE_AUTO, "auto", "foreign nodes from the first tick that has any; Octreel's nodes before")                     \
    X(TREE_OWN, "own", "only Octreel's nodes")                                                                         \
    X(TREE_FOREIGN, "foreign", "only foreign nodes")                                                                   \
    X(TREE_BOTH, "both", "both")

/* The meanings of a point's colour, with the same columns. */
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

/* How points show their distance from the eye, with the same columns. */
#define VIEW_SHADE_MAP(X)                                                                                              \
    X(SHADE_BANDS, "bands", "eight bands, darker with distance")                                                       \
    X(SHADE_EDL, "edl", "eye-dome lighting: points behind nearer ones are darker, which shows surfaces")               \
    X(SHADE_NONE, "none", "not at all")

/* Where the diagram of the tree is drawn, with the same columns. */
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
    FIT_POINTS, /* around the points shown at tick 0; camera_fit_points() replaces it by FIT_BOX */
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
    double zoom;     /* magnification */
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
int view_height_at_16_9(const view *v);

/* The unit of the widths of lines and marks, in whole pixels so that edges stay sharp: 1 if view_height_at_16_9() is
 * below 640, 2 from 640 on, 6 at 2160. */
int view_pixels_per_unit(const view *v);

/* True if points are painted one by one in RGB colours, instead of as markers in colours of the theme. */
static inline bool view_paints_points(const view *v)
{
    return v->point_color != POINTS_BY_PLAIN || v->shade != SHADE_BANDS;
}

/* Samples for each pixel on each axis. */
static inline int view_samples_per_side(const view *v)
{
    return v->aa > 1 ? v->aa : 1;
}

/* True if the frames are RGB, because they need colours that the table of the theme lacks. */
static inline bool view_is_rgb(const view *v)
{
    return view_samples_per_side(v) > 1 || view_paints_points(v);
}

/* The name or the description of the n-th value of an enumeration; null beyond the last. */
typedef const char *view_choice_text(int n);
view_choice_text view_camera_name, view_coloring_name, view_tree_name, view_diagram_name, view_point_color_name,
    view_shade_name, view_camera_words, view_coloring_words, view_tree_words, view_diagram_words,
    view_point_color_words, view_shade_words;

#endif
