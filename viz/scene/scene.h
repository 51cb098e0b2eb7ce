/* SPDX-License-Identifier: MIT */
/* scene.h - the draw list of one tick: the elements of a frame as plain arrays, which tests can check without a GPU.
 *
 * World geometry (boxes, segments, markers, letters) is in world coordinates and is drawn through the camera; panels
 * and labels, and segments with in_picture, are in pixels. Every element has a layer, a role (its colour) and a stable
 * id, unique within its kind and layer.
 */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include "array.h"
#include "camera.h"
#include "lettering.h"
#include "octree/types.h"
#include "theme.h"
#include "view.h"

typedef enum scene_stroke {
    STROKE_SOLID,
    STROKE_DASHED,
    STROKE_CUT, /* dashed, with gaps in the background colour: a solid line beneath looks dashed; letters have a rim of
                   this colour */
    STROKE_ARROW, /* solid, with a head at its second end where it is long enough to be seen */
} scene_stroke;

/* How an element appears. Width is in half units of the frame (view_pixels_per_unit): at 1280 x 720 a pixel. */
typedef struct scene_style {
    uint8_t layer;  /* view_layer: layer.h */
    uint8_t role;   /* theme_role */
    uint8_t stroke; /* scene_stroke */
    uint8_t width;  /* of lines, half the size of markers, and the size of text: 1 is 12 units a line */
} scene_style;

/* The first members of every element. */
typedef struct scene_head {
    uint64_t id;
    scene_style style;
} scene_head;

typedef struct scene_box {
    uint64_t id; /* a node's address in LAYER_NODES */
    scene_style style;
    uint8_t depth; /* of the node; an edge shared by two boxes has the colour of the shallower one */
    octree_box box;
} scene_box;

typedef struct scene_segment {
    uint64_t id;
    scene_style style;
    bool in_picture;
    double ends[2][3]; /* world positions; or, in the picture, x and y in pixels */
} scene_segment;

typedef enum scene_shape {
    SHAPE_SQUARE,
    SHAPE_DIAMOND, /* a square on its corner */
    SHAPE_FRAME,   /* the outline of a square */
    SHAPE_LOZENGE, /* the outline of a diamond */
    SHAPE_CROSS,
    SHAPE_RING,
    SHAPE_TRIANGLE, /* the outline of a triangle on its side */
    SHAPE_WEDGE,    /* a filled triangle on its corner */
    SHAPE_COUNT
} scene_shape;

typedef struct scene_marker {
    uint64_t id; /* a point's in LAYER_POINTS */
    scene_style style;
    uint8_t shape;     /* scene_shape */
    theme_color color; /* used only if the role is ROLE_OWN */
    double at[3];
} scene_marker;

#define SCENE_TEXT 48

/* Text at a pixel, or beside the pixel of a world position. A width of 2 makes it a title. */
typedef struct scene_label {
    uint64_t id;
    scene_style style;
    bool in_world;
    double at[3]; /* a world position, or x and y in pixels of the text's top left corner */
    char text[SCENE_TEXT];
} scene_label;

/* A filled rectangle of the picture, in pixels. */
typedef struct scene_panel {
    uint64_t id;
    scene_style style;
    theme_color color; /* used only if the role is ROLE_OWN */
    int x, y, width, height;
} scene_panel;

/* Counts of velocity arrows that a scene leaves out. */
typedef struct scene_arrows {
    size_t thinned;  /* beyond the view's budget */
    uint64_t one_in; /* about one arrow in `one_in` is kept */
    size_t small;    /* shorter than the view's lod, among the others */
} scene_arrows;

/* Counts of the nodes and points that a scene shows and leaves out. */
typedef struct scene_tally {
    size_t nodes, points; /* shown */
    size_t labels;        /* nodes with their path on them */
    size_t small;         /* nodes below the view's lod */
    size_t small_marked;  /* below the lod: boxes and planes of nodes that the tick visited, split or merged */
    size_t beyond;        /* nodes beyond its budget: all below `deepest` */
    int deepest;          /* the greatest depth that fits the budget */
    size_t thinned;       /* points beyond the budget */
    uint64_t one_in;      /* about one point in `one_in` is kept */
    scene_arrows arrows;
    size_t drawn, folded;                 /* nodes in the diagram: one by one, and in its bars */
    unsigned folded_from, folded_to;      /* the depths that are bars */
    size_t path;                          /* nodes on the path that it shows */
    size_t marked_visited, marked_pruned; /* nodes that it marks as visited or pruned by the tick */
} scene_tally;

/* Kinds of elements that a frame can leave out, as bits. */
enum { LEFT_OUT_NODES = 1, LEFT_OUT_POINTS = 2, LEFT_OUT_ARROWS = 4 };

/* The kinds that the view's budget leaves out, and those that its lod leaves out. */
static inline unsigned scene_count_left_out_beyond(const scene_tally *tally)
{
    return (tally->beyond ? LEFT_OUT_NODES : 0u) | (tally->thinned ? LEFT_OUT_POINTS : 0u) |
           (tally->arrows.thinned ? LEFT_OUT_ARROWS : 0u);
}

static inline unsigned scene_count_left_out_small(const scene_tally *tally)
{
    return (tally->small || tally->small_marked ? LEFT_OUT_NODES : 0u) | (tally->arrows.small ? LEFT_OUT_ARROWS : 0u);
}

typedef struct scene {
    view view;
    camera camera;
    int unit;              /* whole pixels a unit of the widths of lines and marks */
    lettering text, title; /* of labels; see scene_label_lettering() */
    double spacing;        /* between the points that it shows, where they are painted, in world units; 0: not known */
    ARRAY(scene_box) boxes;
    ARRAY(scene_segment) segments;
    ARRAY(scene_marker) markers;
    ARRAY(scene_label) labels;
    ARRAY(scene_panel) panels;
    scene_tally tally;
    struct scene *closeup; /* a scene of its own, drawn into a part of the picture; read where has_closeup */
    bool has_closeup;
    int place[2];           /* of a close-up: the pixel of the picture at which its top left pixel lies */
    double times;           /* of a close-up: its magnification at its middle; 0 in other scenes */
    struct kept_tree *kept; /* cache from the scene of the tick before; may be null */
    size_t refused;         /* elements with NaN or infinite geometry: counted, never drawn */
    bool out_of_memory;     /* set by scene_add_*: the scene is incomplete */
} scene;

/* The letters in which a label is drawn. */
static inline const lettering *scene_label_lettering(const scene *s, const scene_label *label)
{
    return label->style.width > 1 ? &s->title : &s->text;
}

/* Empty a scene for its next tick, keeping its memory. A zeroed scene is empty. */
void scene_clear(scene *s);
void scene_release(scene *s);

/* Set the view, and the sizes that follow from it. The caller sets the camera. */
void scene_set_view(scene *s, const view *v);

/* Append an element, unless the view hides its layer; no other code tests that. */
void scene_add_box(scene *s, scene_box box);
void scene_add_segment(scene *s, scene_segment segment);
void scene_add_marker(scene *s, scene_marker marker);
void scene_add_label(scene *s, scene_label label);
void scene_add_panel(scene *s, scene_panel panel);

/* Returns a label with a formatted text at no place yet. A text that does not fit is cut. */
scene_label scene_make_label(uint64_t id, scene_style style, const char *format, ...);

/* Append a box, a segment in the world, a marker, the markers of points, or a rectangle of the picture. */
void scene_add_outline(scene *s, uint64_t id, const octree_box *box, scene_style style);
void scene_add_line(scene *s, uint64_t id, const double from[3], const double to[3], scene_style style);
void scene_add_mark(scene *s, uint64_t id, const double at[3], scene_shape shape, scene_style style);
void scene_add_points(scene *s, const octree_point *points, size_t count, scene_shape shape, scene_style style);

/* Append a segment in the picture: x and y of its ends in pixels. */
void scene_add_picture_line(scene *s, uint64_t id, const double from[2], const double to[2], scene_style style);

/* Append copies of markers that a scene with the same view had, without testing them again. */
void scene_add_markers(scene *s, const scene_marker *markers, size_t count);

void scene_add_rectangle(scene *s, uint64_t id, const int at[2], const int size[2], unsigned layer, unsigned role);

/* The middle of a box, without overflow of large extents. */
static inline void scene_box_middle(const octree_box *box, double middle[3])
{
    for (int i = 0; i < 3; i++)
        middle[i] = box->min[i] / 2 + box->max[i] / 2;
}

/* The position of a corner of a box: bit i of its number is set at the upper end of axis i. */
static inline void scene_box_corner(const octree_box *box, unsigned corner, double position[3])
{
    for (unsigned i = 0; i < 3; i++)
        position[i] = corner >> i & 1 ? box->max[i] : box->min[i];
}

/* ---- Elements ----------------------------------------------------------------------------------------------- */

/* The arrays of a scene, in the order in which their elements are numbered. */
typedef enum scene_kind { SCENE_BOX, SCENE_SEGMENT, SCENE_MARKER, SCENE_PANEL, SCENE_LABEL, SCENE_KINDS } scene_kind;

/* The position of an element: its kind, its index in the array of that kind, and whether it is in the close-up. */
typedef struct scene_element {
    scene_kind kind;
    size_t index;
    bool in_closeup;
} scene_element;

/* "box", "segment", "marker", "panel", "label". */
const char *scene_kind_name(scene_kind kind);

/* Elements have numbers from 1 on: kind by kind, first those of the scene, then those of its close-up. 0 is the
 * background. */
size_t scene_count_elements(const scene *s); /* without those of the close-up */
scene_element scene_element_at(const scene *s, uint32_t number);
uint32_t scene_element_number(const scene *s, scene_element element);

scene_head scene_element_head(const scene *s, scene_element element);

/* The scene that holds an element: `s` or its close-up. */
static inline const scene *scene_containing(const scene *s, scene_element element)
{
    return element.in_closeup ? s->closeup : s;
}

/* A digest of the whole draw list, camera, size and close-up included: the same on every machine. */
uint64_t scene_digest(const scene *s);

#endif
