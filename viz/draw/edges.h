/* SPDX-License-Identifier: MIT */
/* edges.h - merges the edges of a scene's boxes into segments that do not overlap. Private to this folder. */
#ifndef DRAW_EDGES_H
#define DRAW_EDGES_H

#include "array.h"
#include "hash_map.h"
#include "scene.h"

/* ---- box_lines.c: the set of world lines on which the edges of a scene's boxes lie ---------------------------
 *
 * Edges on the same line may overlap. The set is updated from scene to scene. A line is marked as changed if one of its
 * boxes was added or removed. */

/* A line parallel to one axis. `u` and `v` are the line's coordinates on the next two axes, in cyclic order. */
typedef struct line_key {
    double u, v;
    uint32_t kind; /* layer, stroke, width and axis, packed into one number */
} line_key;

/* Returns the key of the line through the point `at` parallel to an axis. */
static inline line_key line_key_through_point(scene_style style, unsigned axis, const double at[3])
{
    return (line_key){
        .u = at[(axis + 1) % 3],
        .v = at[(axis + 2) % 3],
        .kind = (uint32_t)style.layer << 24 | (uint32_t)style.stroke << 16 | (uint32_t)style.width << 8 | axis,
    };
}

/* Returns the key of the line of a box's edge. Four edges of a box are parallel to `axis`; `corner` selects one of
 * these four edges. */
static inline line_key line_key_of_box_edge(const scene_box *box, unsigned axis, unsigned corner)
{
    double at[3] = {0};
    at[(axis + 1) % 3] = (corner & 1 ? box->box.max : box->box.min)[(axis + 1) % 3];
    at[(axis + 2) % 3] = (corner & 2 ? box->box.max : box->box.min)[(axis + 2) % 3];
    return line_key_through_point(box->style, axis, at);
}

static inline unsigned line_key_axis(const line_key *key)
{
    return key->kind & 0xff;
}

static inline int compare_doubles(double a, double b)
{
    return (a > b) - (a < b);
}

/* Compare two lines in painting order: first by `kind`, then by coordinates. */
static inline int line_key_compare(const line_key *a, const line_key *b)
{
    if (a->kind != b->kind)
        return a->kind < b->kind ? -1 : 1;
    const int u = compare_doubles(a->u, b->u);
    return u ? u : compare_doubles(a->v, b->v);
}

typedef struct line {
    line_key key;
    uint32_t users;        /* the number of box edges on this line */
    uint32_t first, count; /* the line's merged edges: `count` edges of edge_list.now, from index `first` on */
    /* Used only during a merge, in edges.c. intervals: the number of intervals collected for this line. last: the index
     * of the last collected box. start: where the line's range begins in the array for all changed lines. */
    uint32_t intervals, last, start;
} line;

#define LINE_NONE HASH_MAP_NONE
#define BOX_EDGES 12

/* A box, and the lines of its 12 edges: the index of each line, for four edges along each axis. The index is LINE_NONE
 * if the box has no extent along that axis. */
typedef struct lined_box {
    scene_box box;
    uint32_t lines[BOX_EDGES];
} lined_box;

typedef ARRAY(lined_box) lined_boxes;

/* The set of lines on which edges of boxes lie. A zeroed struct is an empty set. */
typedef struct box_lines {
    lined_boxes now, before; /* the boxes of this scene and of the previous scene */
    line *lines;             /* the lines, each with a different key; new lines are appended */
    size_t count, room;
    /* for each line: 1 if a box with an edge on the line was added or removed, so that the line's merged edges are out
     * of date */
    uint8_t *changed;
    size_t changed_room;
    size_t idle;  /* the number of lines without box edges */
    hash_map map; /* maps line keys to indices of lines */
} box_lines;

void box_lines_clear(box_lines *kept);
void box_lines_release(box_lines *kept);

/* Replace the boxes by the boxes of a scene in the layers [first, end). Lines whose boxes were added or removed are
 * marked as changed. *changed becomes true if there are such lines. Returns false if memory runs out; the caller must
 * then call box_lines_clear(). Cost: O(n) for n boxes, plus one hash look-up for each edge of an added box. */
bool box_lines_update(box_lines *kept, const scene *s, unsigned first, unsigned end, bool *changed);

/* ---- edges.c ------------------------------------------------------------------------------------------------- */

/* A merged edge: a segment in the world, parallel to an axis, with one style and depth. */
typedef struct edge {
    double ends[2][3];
    scene_style style;
    uint8_t depth;
} edge;

typedef ARRAY(edge) edge_array;

typedef struct edge_list {
    edge_array now;
    edge_array before; /* the merged edges of the previous scene, used during a merge */
    box_lines boxes;   /* the boxes of the last merged scene, and the lines of these boxes */
    uint32_t *order;   /* indices into boxes.lines, sorted in painting order */
    size_t ordered;    /* the number of lines in `order`, which does not yet contain newer lines */
} edge_list;

void edges_release(edge_list *list);

/* Merge the edges of all boxes in the layers [first, end) into list->now. Returns false if memory runs out.
 *
 * Where edges with the same layer, stroke and width overlap, the shallowest box gives the merged edge its colour.
 * Touching edges with the same depth and colour become one edge. The result is sorted by layer, stroke, width and axis,
 * then by the coordinates of the lines.
 *
 * Cost: O(n log n) for n boxes. If most boxes are the same as in the previous call: O(n) plus the work for changed
 * lines. */
bool edges_merge(edge_list *list, const scene *s, unsigned first, unsigned end);

#endif
