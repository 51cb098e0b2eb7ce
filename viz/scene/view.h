/* view.h - how a scene is looked at: size, camera, layers, colours, and what of the tree is left out. What
 * recording.json keeps.
 *
 * A new layer goes through these rooms: its line of VIEW_LAYER_MAP here, and whether it is on by itself, in
 * VIEW_DEFAULT_LAYERS; what it shows in tick_scene.c and a file of its own beside it; its line of the legend in
 * panel_legend.c, with layers_of() and layers_of_tree(), which say where there can be one; its words in
 * record/element_words.c. What a tick does not say yet goes into octree_tick first. A new colour is a role in theme.h,
 * a curve of a recording's page a line of CURVES in record/viewer/facts.js. Then a structural test, a golden frame, and
 * new digests in test_replay; those of frames that show the new layer change with it.
 */
#ifndef SCENE_VIEW_H
#define SCENE_VIEW_H

#include "octree/octree.h"

#include <stdbool.h>
#include <stdint.h>

/* Each camera and the name that people type. */
#define VIEW_CAMERA_MAP(X)                                                                                             \
    X(ISO, "iso")       /* orthographic, three-quarter view from above */                                              \
    X(TOP, "top")       /* orthographic, along -z; x to the right, y up */                                             \
    X(FRONT, "front")   /* orthographic, along +y; x to the right, z up */                                             \
    X(SIDE, "side")     /* orthographic, along -x; y to the right, z up */                                             \
    X(FOLLOW, "follow") /* perspective, behind and above the player */                                                 \
    X(ORBIT, "orbit")   /* perspective, round the world by a fixed angle a tick */

/* Each layer, its name, what it shows in words, the colour of that (theme.h), and whether it fades with the distance as
 * the tree does: what the tick is about fades less. In painter's order: later layers lie on top. Nodes and heat have a
 * ramp of colours, and nodes that were met keep theirs: of these it is one that stands for all. */
#define VIEW_LAYER_MAP(X)                                                                                              \
    X(WORLD, "world", "the world", ROLE_WORLD, true)                                                                   \
    X(NODES, "nodes", "nodes", ROLE_NODE_PLAIN, true)                                                                  \
    X(VISIT_HEAT, "visit-heat", "heat", ROLE_NODE, false)    /* in how many ticks leaves were visited */               \
    X(POINT_HEAT, "point-heat", "heat", ROLE_NODE, false)    /* how many points were in them, in all ticks together */ \
    X(PRUNED, "pruned", "pruned nodes", ROLE_NODE + 2, true) /* nodes that the tick's questions left out */            \
    X(VISITED, "visited", "visited nodes", ROLE_NODE + 2, false) /* those that they looked into, or took whole */      \
    X(HIT, "hit", "leaves with hits", ROLE_POINT, false)         /* leaves that hold what they found */                \
    X(MERGES, "merges", "merges", ROLE_POINT, false)             /* nodes that ceased to be inner ones at this tick */ \
    X(SPLITS, "splits", "splits", ROLE_POINT, false)             /* nodes that became inner ones */                    \
    X(ASKED, "asked", "the node asked for", ROLE_PLAYER, false)  /* the node that inspect is asked for */              \
    X(POINTS, "points", "points", ROLE_POINT, true)                                                                    \
    X(VELOCITIES, "velocities", "velocities", ROLE_POINT, true) /* where points that move go on to */                  \
    X(RANGE, "range", "range queries", ROLE_RANGE, false)                                                              \
    X(RADIUS, "radius", "radius queries", ROLE_RADIUS, false)                                                          \
    X(KNEAREST, "knearest", "k-nearest queries", ROLE_KNEAREST, false)                                                 \
    X(NEAREST, "nearest", "nearest queries", ROLE_NEAREST, false)                                                      \
    X(PLAYER, "player", "the player", ROLE_PLAYER, false)                                                              \
    X(BOX, "box", "the collision box", ROLE_COLLISION, false)   /* the player's collision box, and what is in it */    \
    X(SHAPES, "shapes", "shapes", ROLE_SHAPE, false)            /* what the session shows beside the points */         \
    X(BROKEN, "broken", "the broken node", ROLE_WARNING, false) /* where the validator finds an invariant broken */    \
    X(TEXT, "text", "text", ROLE_TEXT, false)

/* What the colour of a node tells, and the name of each choice. */
#define VIEW_COLORING_MAP(X)                                                                                           \
    X(DEPTH, "depth")         /* how deep it lies */                                                                   \
    X(OCCUPANCY, "occupancy") /* how many points are in it, on a fixed scale of powers of two */                       \
    X(PLAIN, "plain")         /* nothing */

/* Where the tree is drawn as a tree, and the name of each choice. */
#define VIEW_DIAGRAM_MAP(X)                                                                                            \
    X(NONE, "none")     /* nowhere */                                                                                  \
    X(BESIDE, "beside") /* beside the space view; below it in a picture that is higher than wide */                    \
    X(ONLY, "only")     /* in place of the space view */

typedef enum view_camera {
#define VIEW_CAMERA_ENUM(name, text) CAMERA_##name,
    VIEW_CAMERA_MAP(VIEW_CAMERA_ENUM)
#undef VIEW_CAMERA_ENUM
        CAMERA_COUNT
} view_camera;

typedef enum view_layer {
#define VIEW_LAYER_ENUM(name, ...) LAYER_##name,
    VIEW_LAYER_MAP(VIEW_LAYER_ENUM)
#undef VIEW_LAYER_ENUM
        LAYER_COUNT,
    LAYER_DIAGRAM = LAYER_COUNT /* on top of all; shown where view.diagram says so, and in no list of layers */
} view_layer;

typedef enum view_coloring {
#define VIEW_COLORING_ENUM(name, text) COLORING_##name,
    VIEW_COLORING_MAP(VIEW_COLORING_ENUM)
#undef VIEW_COLORING_ENUM
        COLORING_COUNT
} view_coloring;

typedef enum view_diagram {
#define VIEW_DIAGRAM_ENUM(name, text) DIAGRAM_##name,
    VIEW_DIAGRAM_MAP(VIEW_DIAGRAM_ENUM)
#undef VIEW_DIAGRAM_ENUM
        DIAGRAM_COUNT
} view_diagram;

/* What of the tree is shown; all zero is all of it. See filter.h. */
typedef struct view_filter {
    char slice;                    /* 'x', 'y' or 'z': the nodes that cut a plane across this axis; 0: all */
    double slice_at;               /* where the plane is */
    bool by_depth;                 /* only nodes from min_depth to max_depth */
    unsigned min_depth, max_depth; /* 0 to OCTREE_MAX_DEPTH */
    bool leaves;                   /* only leaves */
    bool by_region;                /* only what meets a closed box */
    octree_box region;
} view_filter;

/* What the camera frames. */
typedef enum view_fit {
    FIT_WORLD,
    FIT_POINTS, /* those that are shown at tick 0; fit_view() makes a box of them */
    FIT_BOX,
} view_fit;

typedef struct view {
    int width, height; /* pixels */
    view_camera camera;
    view_fit fit;
    octree_box focus; /* under FIT_BOX: the box */
    unsigned layers;  /* bit 1 << view_layer */
    view_coloring coloring;
    view_diagram diagram;
    view_filter filter;
    bool labels;     /* the paths of nodes on their boxes */
    double lod;      /* pixels: boxes of nodes that appear smaller are left out where an ancestor's is drawn; 0: none */
    int aa;          /* samples a pixel on each axis, 1, 2 or 4; 0 is 1 */
    uint64_t budget; /* the most boxes of nodes, and the most points, of a frame; 0: any number */
} view;

#define VIEW_ALL_LAYERS ((1u << LAYER_COUNT) - 1)
#define VIEW_HEAT_LAYERS (1u << LAYER_VISIT_HEAT | 1u << LAYER_POINT_HEAT)

/* What is shown unless somebody says otherwise: all about the tick; what went before it is left out. */
#define VIEW_DEFAULT_LAYERS (VIEW_ALL_LAYERS & ~VIEW_HEAT_LAYERS)

/* The longest side of a picture, samples counted: what llvmpipe draws without clamping it. */
#define VIEW_MAX_SIDE 16384

/* What else is so unless somebody says otherwise. */
#define VIEW_DEFAULT_WIDTH 1280
#define VIEW_DEFAULT_HEIGHT 720
#define VIEW_DEFAULT_LOD 2         /* smaller boxes are specks: at 100,000 points no difference is seen up to 4 */
#define VIEW_DEFAULT_BUDGET 250000 /* some 300 MB and a few seconds a frame at worst */

/* These, iso, no anti-aliasing, and nodes coloured by depth. */
view view_default(void);

/* What text and lines are measured in: whole pixels, so that they stay crisp. 1 below a height of 640, 2 from there, 6
 * at 2160; a narrow picture counts as its 16:9 part. */
int view_unit(const view *v);

/* Samples a pixel on each axis. */
static inline int view_samples(const view *v)
{
    return v->aa > 1 ? v->aa : 1;
}

static inline bool view_shows(const view *v, view_layer layer)
{
    return layer == LAYER_DIAGRAM ? v->diagram != DIAGRAM_NONE : v->layers >> layer & 1;
}

/* Names, and null beyond the last. */
const char *view_camera_name(view_camera camera);
const char *view_layer_name(view_layer layer);
const char *view_coloring_name(view_coloring coloring);
const char *view_diagram_name(view_diagram diagram);

/* What a layer shows, in words: "the world", "pruned nodes". The diagram has words too; null beyond it. */
const char *view_layer_words(view_layer layer);

/* The inverse; false when there is no such name. */
bool view_camera_parse(const char *name, view_camera *camera);
bool view_coloring_parse(const char *name, view_coloring *coloring);
bool view_diagram_parse(const char *name, view_diagram *diagram);

/* Layers by a list of names with commas between, or "all", "default" or "none"; "-text" leaves one out, and a list that
 * begins so starts from the default. On failure *bad points at the name that is unknown. */
bool view_layers_parse(const char *list, unsigned *layers, const char **bad);

#endif
