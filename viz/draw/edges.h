/* SPDX-License-Identifier: MIT */
/* edges.h - the edges of a scene's boxes, each once, as maximal segments. For this folder. */
#ifndef DRAW_EDGES_H
#define DRAW_EDGES_H

#include "box_lines.h"

/* A piece of a line in the world that has one colour. */
typedef struct edge {
    double ends[2][3];
    scene_style style;
    uint8_t depth;
} edge;

typedef struct edge_array {
    edge *items;
    size_t count, room;
} edge_array;

typedef struct edge_list {
    edge_array now;
    edge_array before; /* those of the last scene, during a merge */
    box_lines boxes;   /* the boxes that were merged last */
    uint32_t *order;   /* the lines in the order of painting: */
    size_t ordered;    /* how many; newer lines are not in it yet */
} edge_list;

void edges_release(edge_list *list);

/* Merge the edges of all boxes of the layers [first, end) into list->now. Where boxes of one layer, style and width
 * share a stretch, the shallowest gives it its colour; stretches of one depth and colour that meet are one. They come
 * by layer, style, width and axis, and then by where their lines are. False when there is no memory. Cost: O(n log n)
 * for n boxes; where most are those of the last time, O(n) and the lines of the others. */
bool edges_merge(edge_list *list, const scene *s, unsigned first, unsigned end);

#endif
