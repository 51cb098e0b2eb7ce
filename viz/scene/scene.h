/* SPDX-License-Identifier: MIT */
/* scene.h - the draw list of one tick: the elements of a frame as plain arrays, which tests can check without a GPU.
 *
 * Boxes and markers are in world coordinates and are drawn through the camera; panels are in pixels. Segments and
 * labels can be in world coordinates or in pixels of the picture. Every element has a layer, a role (its colour) and a
 * stable id, which is unique within its kind and layer. */
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
    STROKE_CUT,   /* dashes with gaps in the background colour, so that a solid line beneath looks dashed; letters get a
                     rim of this colour */
    STROKE_ARROW, /* solid, with an arrow head at the second end if the line is long enough to show it */
} scene_stroke;

/* How an element appears. The width is in half units of the frame (view_pixels_per_unit), which are pixels at 1280 x
 * 720. */
typedef struct scene_style {
    uint8_t layer;  /* a view_layer: layer.h */
    uint8_t role;   /* a theme_role: the colour */
    uint8_t stroke; /* a scene_stroke */
    uint8_t width;  /* of lines; half the side of markers; the size of text: 1 is 12 units per line of text */
} scene_style;

/* The members with which every element begins. */
typedef struct scene_head {
    uint64_t id;
    scene_style style;
} scene_head;

typedef struct scene_box {
    uint64_t id; /* if the layer is LAYER_NODES, the node's address */
    scene_style style;
    uint8_t depth; /* the node's depth; an edge shared by two boxes has the colour of the shallower box */
    octree_box box;
} scene_box;

typedef struct scene_segment {
    uint64_t id;
    scene_style style;
    bool in_picture;
    double ends[2][3]; /* world positions or, if in_picture is set, x and y in pixels */
} scene_segment;

typedef enum scene_shape {
    SHAPE_SQUARE,
    SHAPE_DIAMOND, /* a filled square that stands on a corner */
    SHAPE_FRAME,   /* the outline of a square */
    SHAPE_LOZENGE, /* the outline of a diamond */
    SHAPE_CROSS,
    SHAPE_RING,
    SHAPE_TRIANGLE, /* the outline of a triangle that stands on a side */
    SHAPE_WEDGE,    /* a filled triangle that stands on a corner */
    SHAPE_COUNT
} scene_shape;

typedef struct scene_marker {
    uint64_t id; /* if the layer is LAYER_POINTS, the point's id */
    scene_style style;
    uint8_t shape;     /* a scene_shape */
    theme_color color; /* used only if style.role is ROLE_OWN */
    double at[3];
} scene_marker;

#define SCENE_TEXT 48

/* A text at a pixel, or beside the pixel of a world position. A label of width 2 is a title. */
typedef struct scene_label {
    uint64_t id;
    scene_style style;
    bool in_world;
    double at[3]; /* a world position if in_world is set, else x and y of the text's top left corner in pixels */
    char text[SCENE_TEXT];
} scene_label;

/* A filled rectangle of the picture, in pixels. */
typedef struct scene_panel {
    uint64_t id;
    scene_style style;
    theme_color color; /* used only if style.role is ROLE_OWN */
    int x, y, width, height;
} scene_panel;

/* Counts of velocity arrows that a scene leaves out. */
typedef struct scene_arrows {
    size_t thinned;  /* the number of arrows left out because of the view's budget */
    uint64_t one_in; /* about one arrow in `one_in` is kept */
    size_t small;    /* arrows within the budget that are left out because they are shorter than the view's lod */
} scene_arrows;

/* Counts of the nodes and points that a scene shows and leaves out. */
typedef struct scene_tally {
    size_t nodes, points; /* the numbers of nodes and points that are shown */
    size_t labels;        /* the number of nodes that are labelled with their path */
    size_t small;         /* the number of nodes left out because they are smaller than the view's lod */
    size_t small_marked;  /* boxes and planes of visited, split or merged nodes left out because of the lod */
    size_t beyond;   /* the number of nodes left out because of the view's budget: all nodes below depth `deepest` */
    int deepest;     /* the greatest depth whose nodes fit the budget */
    size_t thinned;  /* the number of points left out because of the budget */
    uint64_t one_in; /* about one point in `one_in` is kept */
    scene_arrows arrows;
    size_t drawn, folded;                 /* the numbers of nodes that the diagram shows one by one, and in bars */
    unsigned folded_from, folded_to;      /* the range of depths that the diagram shows as bars */
    size_t path;                          /* the number of nodes on the path that the diagram shows */
    size_t marked_visited, marked_pruned; /* the numbers of nodes that the diagram marks as visited, and as pruned */
} scene_tally;

/* Kinds of elements that a frame can leave out, as bits. */
enum { LEFT_OUT_NODES = 1, LEFT_OUT_POINTS = 2, LEFT_OUT_ARROWS = 4 };

/* The first function returns the kinds that the view's budget leaves out, the second those that its lod leaves out. */
static inline unsigned scene_kinds_beyond_budget(const scene_tally *tally)
{
    return (tally->beyond ? LEFT_OUT_NODES : 0u) | (tally->thinned ? LEFT_OUT_POINTS : 0u) |
           (tally->arrows.thinned ? LEFT_OUT_ARROWS : 0u);
}

static inline unsigned scene_kinds_below_lod(const scene_tally *tally)
{
    return (tally->small || tally->small_marked ? LEFT_OUT_NODES : 0u) | (tally->arrows.small ? LEFT_OUT_ARROWS : 0u);
}

typedef struct scene {
    view view;
    camera camera;
    int unit;              /* the size of one unit of the widths of lines and markers, in whole pixels */
    lettering text, title; /* the letters of labels; see scene_label_lettering() */
    double spacing;        /* if points are painted: the spacing of the shown points, in world units; 0: unknown */
    ARRAY(scene_box) boxes;
    ARRAY(scene_segment) segments;
    ARRAY(scene_marker) markers;
    ARRAY(scene_label) labels;
    ARRAY(scene_panel) panels;
    scene_tally tally;
    struct scene *closeup; /* a separate scene, drawn into a part of the picture; valid if has_closeup is set */
    bool has_closeup;
    int place[2];           /* in a close-up: the pixel of the picture at which its top left pixel lies */
    double times;           /* in a close-up: the magnification at its middle; 0 in other scenes */
    struct kept_tree *kept; /* the cache of subtrees from the last tick; may be null */
    size_t refused;         /* the number of elements with NaN or infinite geometry, which are never drawn */
    bool out_of_memory;     /* set by scene_add_*: the scene is incomplete */
} scene;

/* Returns the letters in which a label is drawn. */
static inline const lettering *scene_label_lettering(const scene *s, const scene_label *label)
{
    return label->style.width > 1 ? &s->title : &s->text;
}

/* Empty a scene for its next tick, without freeing its memory. A zeroed scene is empty. */
void scene_clear(scene *s);
void scene_release(scene *s);

/* Set the view and the sizes that depend on it. The caller sets the camera. */
void scene_set_view(scene *s, const view *v);

/* Append an element, unless the view hides its layer. Callers need not test the layer. */
void scene_add_box(scene *s, scene_box box);
void scene_add_segment(scene *s, scene_segment segment);
void scene_add_marker(scene *s, scene_marker marker);
void scene_add_label(scene *s, scene_label label);
void scene_add_panel(scene *s, scene_panel panel);

/* Returns a label with a formatted text and no position yet. A text that is too long is truncated. */
scene_label scene_make_label(uint64_t id, scene_style style, const char *format, ...);

/* Append a box, a segment in the world, a marker, markers for points, or a filled rectangle of the picture. */
void scene_add_outline(scene *s, uint64_t id, const octree_box *box, scene_style style);
void scene_add_line(scene *s, uint64_t id, const double from[3], const double to[3], scene_style style);
void scene_add_mark(scene *s, uint64_t id, const double at[3], scene_shape shape, scene_style style);
void scene_add_points(scene *s, const octree_point *points, size_t count, scene_shape shape, scene_style style);

/* Append a segment in the picture. `from` and `to` are x and y of its ends in pixels. */
void scene_add_picture_line(scene *s, uint64_t id, const double from[2], const double to[2], scene_style style);

/* Append copies of markers from a scene with the same view, without testing their layer and geometry again. */
void scene_add_markers(scene *s, const scene_marker *markers, size_t count);

void scene_add_rectangle(scene *s, uint64_t id, const int at[2], const int size[2], unsigned layer, unsigned role);

/* Compute the middle of a box. Large extents do not overflow. */
static inline void scene_box_middle(const octree_box *box, double middle[3])
{
    for (int i = 0; i < 3; i++)
        middle[i] = box->min[i] / 2 + box->max[i] / 2;
}

/* ---- Elements ----------------------------------------------------------------------------------------------- */

/* The kinds of elements, one for each array of a scene, in the order in which elements are numbered. */
typedef enum scene_kind { SCENE_BOX, SCENE_SEGMENT, SCENE_MARKER, SCENE_PANEL, SCENE_LABEL, SCENE_KINDS } scene_kind;

/* A reference to an element: its kind, its index in the array of this kind, and whether it is in the close-up. */
typedef struct scene_element {
    scene_kind kind;
    size_t index;
    bool in_closeup;
} scene_element;

/* Returns "box", "segment", "marker", "panel" or "label". */
const char *scene_kind_name(scene_kind kind);

/* Elements are numbered from 1, kind by kind: first the elements of the scene, then those of its close-up. The number 0
 * is the background. */
size_t scene_count_elements(const scene *s); /* without elements of the close-up */
scene_element scene_element_at(const scene *s, uint32_t number);
uint32_t scene_element_number(const scene *s, scene_element element);

scene_head scene_element_head(const scene *s, scene_element element);

/* Returns the scene that holds an element: `s` or its close-up. */
static inline const scene *scene_containing(const scene *s, scene_element element)
{
    return element.in_closeup ? s->closeup : s;
}

/* Returns a digest of the whole draw list, including camera, size and close-up. It is the same on every machine. */
uint64_t scene_digest(const scene *s);

#endif
