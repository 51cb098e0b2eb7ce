/* SPDX-License-Identifier: MIT */
/* view.h - how a scene is viewed: size, camera, layers, colours and filter. recording.json stores it. */
#ifndef SCENE_VIEW_H
#define SCENE_VIEW_H

#include "filter.h"

#include <stdbool.h>
#include <stdint.h>

/* Each camera, the name that people type, and what it shows, in --help. */
#define VIEW_CAMERA_MAP(X)                                                                                             \
    X(ISO, "iso", "from above, a three-quarter view, orthographic")                                                    \
    X(TOP, "top", "along -z, x to the right, y up, orthographic")                                                      \
    X(FRONT, "front", "along +y, x to the right, z up, orthographic")                                                  \
    X(SIDE, "side", "along -x, y to the right, z up, orthographic")                                                    \
    X(FOLLOW, "follow", "from behind and above the player, in perspective")                                            \
    X(ORBIT, "orbit", "round the world by a fixed angle a tick, in perspective")

/* What the colour of a node means: the same of each choice. */
#define VIEW_COLORING_MAP(X)                                                                                           \
    X(DEPTH, "depth", "how deep it lies")                                                                              \
    X(OCCUPANCY, "occupancy", "how many points are in a leaf, up to its capacity; of a program's, in powers of two")   \
    X(PLAIN, "plain", "nothing: all have one colour")                                                                  \
    X(KIND, "kind", "what a node of a program's own tree is, by its word")

/* Whose nodes are shown, where a program's session has nodes of its own tree: the same of each choice. */
#define VIEW_TREE_MAP(X)                                                                                               \
    X(AUTO, "auto", "the program's, from the tick on that has any; Octreel's without")                                 \
    X(OWN, "own", "Octreel's alone")                                                                                   \
    X(FOREIGN, "foreign", "the program's alone")                                                                       \
    X(BOTH, "both", "both")

/* What the colour of a point means. */
#define VIEW_POINT_COLOR_MAP(ROW)                                                                                      \
    ROW(PLAIN, "plain", "nothing: all have one colour")                                                                \
    ROW(HEIGHT, "height", "how high it lies, which is z")                                                              \
    ROW(X, "x", "its x")                                                                                               \
    ROW(Y, "y", "its y")                                                                                               \
    ROW(Z, "z", "its z")                                                                                               \
    ROW(FILE, "file", "its own colour, that its file gives it")                                                        \
    ROW(LEAF, "leaf", "its leaf: dark and light by turns, in its own colour or that of height")                        \
    ROW(DEPTH, "depth", "how deep its leaf lies in the tree")                                                          \
    ROW(DENSITY, "density", "how many points share its pixel")                                                         \
    ROW(CLASS, "class", "its class, as of LAS: ground, vegetation, buildings, water")                                  \
    ROW(INTENSITY, "intensity", "its intensity")                                                                       \
    ROW(ID, "id", "its id: of a cloud, its place in the file")

/* What tells how far away a point is. */
#define VIEW_SHADE_MAP(X)                                                                                              \
    X(BANDS, "bands", "eight bands, darker with depth")                                                                \
    X(EDL, "edl", "eye-dome lighting: darker behind what is nearer, which shows surfaces")                             \
    X(NONE, "none", "nothing")

/* Where the diagram of the tree is drawn: the same of each choice. */
#define VIEW_DIAGRAM_MAP(X)                                                                                            \
    X(NONE, "none", "nowhere")                                                                                         \
    X(BESIDE, "beside", "beside the space view; below it in a picture that is higher than wide")                       \
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

/* What the points shown at tick 0 are like: point_scale.h. */
typedef struct point_scale {
    double low[3], high[3]; /* where nearly all of them are */
    double ids[2];          /* the least and the greatest */
    double intensities[2];  /* nearly all of them; of POINTS_BY_INTENSITY alone */
    double spacing;         /* from one to the next on a surface, about; 0: not known */
} point_scale;

/* What the camera frames. */
typedef enum view_fit {
    FIT_WORLD,
    FIT_POINTS, /* the points shown at tick 0; camera_fit() turns this into FIT_BOX */
    FIT_BOX,
} view_fit;

typedef struct view {
    int width, height; /* pixels */
    view_camera camera;
    view_fit fit;
    octree_box focus; /* under FIT_BOX: the box */
    struct {
        bool given;
        double azimuth, elevation; /* degrees, of the eye: azimuth from -y towards +x, elevation from -90 to 90 */
    } look;                        /* in place of the camera's own direction */
    struct {
        bool given;
        double place[3]; /* in world coordinates */
    } center;            /* what the camera looks at, in place of the middle of what it frames, or of the player */
    double zoom;         /* magnification of the camera's picture; 0 is 1 */
    unsigned layers;     /* bit 1 << view_layer: layer.h */
    view_coloring coloring;
    view_point_color point_color;
    view_shade shade;
    struct {
        bool given;
        point_scale of;
    } point_scale; /* of painted points */
    view_tree tree;
    view_diagram diagram; /* of Octreel's tree, whichever the space view shows */
    view_filter filter;
    bool labels;  /* the paths of nodes on their boxes */
    bool closeup; /* what appears small is shown larger in a part of the picture: compose/closeup_course.h says what */
    double lod;   /* pixels: boxes of nodes that appear smaller are left out when an ancestor's is drawn; 0: none are */
    int aa;       /* samples a pixel on each axis, 1, 2 or 4; 0 is 1 */
    uint64_t budget; /* the most boxes of nodes of each tree, and the most points, of a frame, and 1000 times the most
                        arrows of moving points; 0: any number */
} view;

/* The longest side of a picture, samples counted: what llvmpipe draws without clamping it. */
#define VIEW_MAX_SIDE 16384

/* The height of a picture, or of its 16:9 part where it is narrower than that. */
int view_height_in_wide(const view *v);

/* The unit of the widths of lines and marks, in whole pixels so that they stay crisp: 1 below that height of 640, 2
 * from there, 6 at 2160. */
int view_unit(const view *v);

/* Whether points are painted one by one, with colours of their own: not as marks of the theme's table. */
static inline bool view_paints_points(const view *v)
{
    return v->point_color != POINTS_BY_PLAIN || v->shade != SHADE_BANDS;
}

static inline double view_zoom(const view *v)
{
    return v->zoom > 0 ? v->zoom : 1;
}

/* Samples a pixel on each axis. */
static inline int view_samples(const view *v)
{
    return v->aa > 1 ? v->aa : 1;
}

/* Whether its frames are RGB, for colours that the theme's table does not have. */
static inline bool view_is_rgb(const view *v)
{
    return view_samples(v) > 1 || view_paints_points(v);
}

/* The name; null beyond the last. */
const char *view_camera_name(view_camera camera);
const char *view_coloring_name(view_coloring coloring);
const char *view_tree_name(view_tree tree);
const char *view_diagram_name(view_diagram diagram);
const char *view_point_color_name(view_point_color color);
const char *view_shade_name(view_shade shade);

/* What a choice is, in some words; null beyond the last. */
const char *view_camera_words(view_camera camera);
const char *view_coloring_words(view_coloring coloring);
const char *view_tree_words(view_tree tree);
const char *view_diagram_words(view_diagram diagram);
const char *view_point_color_words(view_point_color color);
const char *view_shade_words(view_shade shade);

#endif
