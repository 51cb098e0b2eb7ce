/* SPDX-License-Identifier: MIT */
/* edge_boxes.h - which boxes lie on a merged edge. An edge is one stroke for all boxes that share it. To find these at
 * a sample, the sample is mapped back to a place on the line. The map from a line to its projection is a quotient of
 * linear functions, and so is its inverse. For this folder.
 */
#ifndef DRAW_EDGE_BOXES_H
#define DRAW_EDGE_BOXES_H

#include "edges.h"

/* One edge of one box. */
typedef struct box_edge {
    line_key line;
    double from, to;
    uint32_t box;
    uint8_t depth;
} box_edge;

/* The edges of all boxes of a scene, sorted by the lines that they lie on. */
typedef struct edge_boxes {
    const scene *scene; /* in samples; must outlive this */
    box_edge *items;
    size_t count;
} edge_boxes;

/* False when there is no memory. */
bool edge_boxes_make(edge_boxes *all, const scene *s);
void edge_boxes_release(edge_boxes *all);

/* The index of the box that gives an edge of edges_merge() its colour at a sample. */
size_t edge_boxes_owner(const edge_boxes *all, const edge *e, int x, int y);

/* All boxes that have an edge where this one passes through a sample, the owner among them; some twice. */
void edge_boxes_visit(const edge_boxes *all, const edge *e, int x, int y, void (*visit)(size_t box, void *context),
                      void *context);

#endif
