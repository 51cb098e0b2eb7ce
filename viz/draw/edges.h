/* SPDX-License-Identifier: MIT */
/* edges.h - merges the edges of a scene's boxes into segments that do not overlap. Private to this folder. */
#ifndef DRAW_EDGES_H
#define DRAW_EDGES_H

#include "array.h"
#include "box_lines.h"

/* A segment of a line in the world, parallel to an axis, with one style and depth. */
typedef struct edge {
    double ends[2][3];
    scene_style style;
    uint8_t depth;
} edge;

typedef ARRAY(edge) edge_array;

typedef struct edge_list {
    edge_array now;
    edge_array before; /* the edges of the last scene, used during a merge */
    box_lines boxes;   /* the boxes of the last scene and their lines */
    uint32_t *order;   /* indices of lines, in painting order; */
    size_t ordered;    /* their number: newer lines are not among them yet */
} edge_list;

void edges_release(edge_list *list);

/* Merge the edges of all boxes in the layers [first, end) into list->now. Where boxes with one layer, stroke and width
 * overlap, the shallowest box gives the edge its colour; edges of one depth and colour that touch become one. Sorted by
 * layer, stroke, width and axis, then by the coordinates of their lines. False when out of memory. Cost: O(n log n) for
 * n boxes; where most boxes are those of the last call, O(n) plus the work for changed lines. */
bool edges_merge(edge_list *list, const scene *s, unsigned first, unsigned end);

#endif
