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
    /* dashes with gaps in the background colour, so that a solid line beneath looks dashed; text gets a rim of the
     * background colour */
    STROKE_CUT,
    STROKE_ARROW, /* solid, with an arrow head at the second end if the line is long enough to show it */
} scene_stroke;

/* How an element appears. Widths are in half picture units; view_pixels_per_unit() is the size of a unit. At 1280 x
 * 720, a half unit is one pixel. */
typedef struct scene_style {
    uint8_t layer;  /* the element's layer: a view_layer (layer.h) */
    uint8_t role;   /* the element's colour: a theme_role */
    uint8_t stroke; /* how lines are drawn: a scene_stroke */
    /* the width of a line; half the side of a marker; the size of a text, where 1 means 12 units per line of text */
    uint8_t width;
} scene_style;

/* The members with which every kind of element begins. */
typedef struct scene_head {
    uint64_t id;
    scene_style style;
} scene_head;

typedef struct scene_box {
    uint64_t id; /* the element's id; in LAYER_NODES, the node's address */
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
    uint64_t id; /* the element's id; in LAYER_POINTS, the point's id */
    scene_style style;
    uint8_t shape;     /* the marker's shape: a scene_shape */
    theme_color color; /* the marker's colour; used only if style.role is ROLE_OWN */
    double at[3];
} scene_marker;

#define SCENE_TEXT 48

/* A text at a pixel, or beside the pixel of a world position. A label whose style has the width 2 is a title. */
typedef struct scene_label {
    uint64_t id;
    scene_style style;
    bool in_world;
    double at[3]; /* the world position if in_world is true; else x and y of the text's top left corner in pixels */
    char text[SCENE_TEXT];
} scene_label;

/* A filled rectangle of the picture, in pixels. */
typedef struct scene_panel {
    uint64_t id;
    scene_style style;
    theme_color color; /* the rectangle's colour; used only if style.role is ROLE_OWN */
    int x, y, width, height;
} scene_panel;

/* Counts of velocity arrows that a scene leaves out. */
typedef struct scene_arrows {
    size_t thinned;  /* the number of arrows left out because of the view's budget */
    uint64_t one_in; /* one in `one_in` arrows is kept, on average */
    /* the number of arrows left out because they are shorter than the view's lod, not because of the budget */
    size_t small;
} scene_arrows;

/* Counts of the nodes and points that a scene shows or leaves out. */
typedef struct scene_tally {
    size_t nodes, points; /* the numbers of nodes and points that are shown */
    size_t labels;        /* the number of nodes that are labelled with their address */
    size_t small;         /* the number of nodes left out because they are smaller than the view's lod */
    /* the number of boxes and planes of visited, split or merged nodes left out because of the lod */
    size_t small_marked;
    size_t beyond;   /* the number of nodes left out because of the view's budget: all nodes below depth `deepest` */
    int deepest;     /* the greatest depth whose nodes fit the budget */
    size_t thinned;  /* the number of points left out because of the view's budget */
    uint64_t one_in; /* one in `one_in` points is kept, on average */
    scene_arrows arrows;
    /* the number of nodes that the diagram shows one by one; the number of nodes that it shows in bars */
    size_t drawn, folded;
    unsigned folded_from, folded_to; /* the range of depths that the diagram shows as bars */
    size_t path;                     /* the number of nodes on the diagram's path from the root */
    /* the number of nodes that the diagram marks as visited; the number that it marks as pruned */
    size_t marked_visited, marked_pruned;
} scene_tally;

/* Kinds of elements that a frame can leave out, as bits. */
enum { LEFT_OUT_NODES = 1, LEFT_OUT_POINTS = 2, LEFT_OUT_ARROWS = 4 };

/* scene_kinds_beyond_budget() returns the kinds of elements that the view's budget leaves out. scene_kinds_below_lod()
 * returns the kinds that the view's lod leaves out. */
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
    /* the size of a picture unit, in which widths of lines and markers are measured, in whole pixels */
    int unit;
    lettering text, title; /* the bitmap fonts of text and of titles; see scene_label_lettering() */
    double spacing;        /* the spacing of the shown points in world units, if points are painted; 0: unknown */
    ARRAY(scene_box) boxes;
    ARRAY(scene_segment) segments;
    ARRAY(scene_marker) markers;
    ARRAY(scene_label) labels;
    ARRAY(scene_panel) panels;
    scene_tally tally;
    struct scene *closeup; /* a separate scene, drawn into a part of the picture; valid if has_closeup is true */
    bool has_closeup;
    /* only in a close-up: the pixel of the picture at which the close-up's top left pixel lies */
    int place[2];
    double times;           /* only in a close-up: the magnification in the middle of the close-up; 0 in other scenes */
    struct kept_tree *kept; /* the cache of subtrees from the previous tick; may be null */
    /* if view.text_apart is true: receives the rows of the text column as elements of an array (pen.h); null: no rows
     * are written */
    struct json_writer *rows;
    size_t refused; /* the number of elements that scene_add_*() refused, because their geometry is NaN or infinite */
    bool out_of_memory; /* true: the scene is incomplete, because memory ran out in scene_add_*() */
} scene;

/* Returns the bitmap font in which a label is drawn. */
static inline const lettering *scene_label_lettering(const scene *s, const scene_label *label)
{
    return label->style.width > 1 ? &s->title : &s->text;
}

/* Empty a scene for its next tick, without freeing its memory. A zeroed scene is empty. */
void scene_clear(scene *s);
void scene_release(scene *s);

/* Set the view, and compute the sizes that depend on the view. The caller sets the camera. */
void scene_set_view(scene *s, const view *v);

/* Append an element, unless the view hides the element's layer, or its geometry is not finite. The caller need not test
 * these conditions. */
void scene_add_box(scene *s, scene_box box);
void scene_add_segment(scene *s, scene_segment segment);
void scene_add_marker(scene *s, scene_marker marker);
void scene_add_label(scene *s, scene_label label);
void scene_add_panel(scene *s, scene_panel panel);

/* Returns a label with a formatted text and no position yet. A text that is too long is cut. */
scene_label scene_make_label(uint64_t id, scene_style style, const char *format, ...);

/* Append a box, a segment in the world, a marker, markers for points, or a filled rectangle of the picture. */
void scene_add_outline(scene *s, uint64_t id, const octree_box *box, scene_style style);
void scene_add_line(scene *s, uint64_t id, const double from[3], const double to[3], scene_style style);
void scene_add_mark(scene *s, uint64_t id, const double at[3], scene_shape shape, scene_style style);
void scene_add_points(scene *s, const octree_point *points, size_t count, scene_shape shape, scene_style style);

/* Append a segment in the picture. `from` and `to` are the ends of the segment: x and y in pixels. */
void scene_add_picture_line(scene *s, uint64_t id, const double from[2], const double to[2], scene_style style);

/* Append copies of markers from a scene with the same view. Their layer and geometry are not tested again. */
void scene_add_markers(scene *s, const scene_marker *markers, size_t count);

void scene_add_rectangle(scene *s, uint64_t id, const int at[2], const int size[2], unsigned layer, unsigned role);

/* Compute the middle of a box. Large extents do not overflow. */
static inline void scene_box_middle(const octree_box *box, double middle[3])
{
    for (int i = 0; i < 3; i++)
        middle[i] = box->min[i] / 2 + box->max[i] / 2;
}

/* ---- Elements ----------------------------------------------------------------------------------------------- */

/* The kinds of elements, in the order in which elements are numbered. A scene has one array for each kind. */
typedef enum scene_kind { SCENE_BOX, SCENE_SEGMENT, SCENE_MARKER, SCENE_PANEL, SCENE_LABEL, SCENE_KINDS } scene_kind;

/* A reference to an element: its kind, its index in the array of this kind, and whether the element is in the
 * close-up. */
typedef struct scene_element {
    scene_kind kind;
    size_t index;
    bool in_closeup;
} scene_element;

/* Returns "box", "segment", "marker", "panel" or "label". */
const char *scene_kind_name(scene_kind kind);

/* Elements are numbered from 1: first the elements of the scene, kind by kind, then the elements of its close-up. The
 * number 0 is the background. */
size_t scene_count_elements(const scene *s); /* the result does not count elements of the close-up */
scene_element scene_element_at(const scene *s, uint32_t number);
uint32_t scene_element_number(const scene *s, scene_element element);

scene_head scene_element_head(const scene *s, scene_element element);

/* Returns the scene that holds an element: `s` or its close-up. */
static inline const scene *scene_containing(const scene *s, scene_element element)
{
    return element.in_closeup ? s->closeup : s;
}

/* Returns a digest of the whole draw list, including camera, picture size and close-up. The digest is the same on every
 * machine. */
uint64_t scene_digest(const scene *s);

#endif
