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
    X(CAMERA_FOLLOW, "follow",                                                                                         \
      "from behind and above the player, in perspective; without a player, it shows the whole world")                  \
    X(CAMERA_ORBIT, "orbit", "circling the world by a fixed angle each tick, in perspective")

/* What a node's colour shows. Columns: value, name on the command line, description in --help. */
#define VIEW_COLORING_MAP(X)                                                                                           \
    X(COLORING_DEPTH, "depth", "its depth in the tree")                                                                \
    X(COLORING_OCCUPANCY, "occupancy",                                                                                 \
      "the number of points in a leaf, relative to its capacity; for a foreign leaf, in powers of two")                \
    X(COLORING_PLAIN, "plain", "nothing: all nodes have the same colour")                                              \
    X(COLORING_KIND, "kind", "the kind of a foreign node")

/* The trees whose nodes are shown if the session has foreign nodes. Columns: value, name on the command line,
 * description in --help. */
#define VIEW_TREE_MAP(X)                                                                                               \
    X(TREE_AUTO, "auto", "Octreel's nodes until a tick has foreign nodes, and from then on the foreign nodes")         \
    X(TREE_OWN, "own", "only Octreel's nodes")                                                                         \
    X(TREE_FOREIGN, "foreign", "only foreign nodes")                                                                   \
    X(TREE_BOTH, "both", "both")

/* What a point's colour shows. Columns: value, name on the command line, description in --help. */
#define VIEW_POINT_COLOR_MAP(X)                                                                                        \
    X(POINTS_BY_PLAIN, "plain", "nothing: all points have the same colour")                                            \
    X(POINTS_BY_HEIGHT, "height", "its height, the z coordinate")                                                      \
    X(POINTS_BY_X, "x", "its x")                                                                                       \
    X(POINTS_BY_Y, "y", "its y")                                                                                       \
    X(POINTS_BY_Z, "z", "its z")                                                                                       \
    X(POINTS_BY_FILE, "file", "its own colour, from the file or the session")                                          \
    X(POINTS_BY_LEAF, "leaf",                                                                                          \
      "its leaf: leaves are alternately dark and light, in the point's own colour or the colour of its height")        \
    X(POINTS_BY_DEPTH, "depth", "the depth of its leaf in the tree")                                                   \
    X(POINTS_BY_DENSITY, "density", "the number of points in its pixel")                                               \
    X(POINTS_BY_CLASS, "class", "its class, as in LAS: ground, vegetation, buildings, water")                          \
    X(POINTS_BY_INTENSITY, "intensity", "its intensity")                                                               \
    X(POINTS_BY_ID, "id", "its id; in a cloud, its row in the file")

/* How points show their distance from the eye. Columns: value, name on the command line, description in --help. */
#define VIEW_SHADE_MAP(X)                                                                                              \
    X(SHADE_BANDS, "bands", "eight bands, darker with distance")                                                       \
    X(SHADE_EDL, "edl", "eye-dome lighting: points behind nearer points are darker, which shows surfaces")             \
    X(SHADE_NONE, "none", "not at all")

/* Where the diagram of the tree is drawn. Columns: value, name on the command line, description in --help. */
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

/* The ranges and the spacing of the points shown at tick 0. They determine the colours and sizes of points;
 * point_scale.c computes them. */
typedef struct point_scale {
    double low[3], high[3]; /* the range of positions on each axis, without outliers */
    double ids[2];          /* the least and the greatest id of the points */
    double intensities[2];  /* the range of intensities, without outliers; only for POINTS_BY_INTENSITY */
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
    /* the picture height from which the sizes of lines, markers and characters follow; 0: the height that
     * view_height_at_16_9() computes. Only pages set this member, because their pictures differ in resolution from
     * recorded frames. */
    int suited_height;
    /* true: the column of text is not part of the picture; scene.rows receives its rows */
    bool text_apart;
    view_camera camera;
    view_fit fit;
    octree_box focus; /* the framed box if `fit` is FIT_BOX */
    struct {
        bool given;
        /* The direction from the center to the eye, in degrees: azimuth from -y towards +x, elevation from -90 to
         * 90. */
        double azimuth, elevation;
    } look; /* the direction of the camera; if given, it replaces the direction of the camera kind */
    struct {
        bool given;
        double place[3]; /* the world position that the camera looks at */
    } center;        /* if given, the camera looks at `place`, not at the middle of the framed box or at the player */
    double zoom;     /* the magnification of the picture */
    unsigned layers; /* the layers that are shown, as bits 1 << view_layer (layer.h) */
    view_coloring coloring;
    view_point_color point_color;
    view_shade shade;
    struct {
        bool given;
        point_scale of;
    } point_scale; /* used only if the view paints points */
    view_tree tree;
    /* where the diagram is drawn; it shows Octreel's tree even if the space view shows foreign nodes */
    view_diagram diagram;
    view_filter filter;
    bool labels; /* true: write the addresses of nodes on their boxes */
    /* true: enlarge a small part of the world in a part of the picture; compose/closeup_course.h chooses the place */
    bool closeup;
    /* leave out boxes of nodes that are smaller than this many pixels if an ancestor's box is drawn; 0: leave out
     * none */
    double lod;
    int aa; /* samples per pixel on each axis: 1, 2 or 4 */
    /* the maximum number of boxes in a frame (for each tree), and the maximum number of points; the maximum number of
     * velocity arrows is a thousandth of this number. 0: no limits */
    uint64_t budget;
} view;

/* The longest side of a picture in samples: llvmpipe clamps longer sides. */
#define VIEW_MAX_SIDE 16384

/* Returns the height from which the sizes of lines and characters follow: the view's suited_height or, if this is 0,
 * the height of the picture, but at most the height of a 16:9 picture of the same width. */
int view_height_at_16_9(const view *v);

/* Returns the size of a picture unit in pixels: 1 if view_height_at_16_9() is below 640, 2 from 640 on, 6 at 2160.
 * Widths of lines and markers are measured in picture units. A unit is a whole number of pixels, so that edges stay
 * sharp. */
int view_pixels_per_unit(const view *v);

/* Returns whether points are painted one by one in RGB colours. If not, points are markers in colours of the theme. */
static inline bool view_paints_points(const view *v)
{
    return v->point_color != POINTS_BY_PLAIN || v->shade != SHADE_BANDS;
}

/* Returns whether frames are RGB, because they need colours that are not in the theme's table. */
static inline bool view_is_rgb(const view *v)
{
    return v->aa > 1 || view_paints_points(v);
}

/* Returns the name or the description of the n-th value of an enumeration. Returns null if n is beyond the last
 * value. */
typedef const char *view_choice_text(int n);
view_choice_text view_camera_name, view_coloring_name, view_tree_name, view_diagram_name, view_point_color_name,
    view_shade_name, view_camera_words, view_coloring_words, view_tree_words, view_diagram_words,
    view_point_color_words, view_shade_words;

#endif
