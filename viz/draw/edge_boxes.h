/* SPDX-License-Identifier: MIT */
/* edge_boxes.h - finds the boxes that share a merged edge at a sample of the picture. Private to this folder. */
#ifndef DRAW_EDGE_BOXES_H
#define DRAW_EDGE_BOXES_H

#include "edges.h"

/* One edge of one box: the interval [from, to] on its line. `box` is the index of the box in the scene. */
typedef struct box_edge {
    line_key line;
    double from, to;
    uint32_t box;
    uint8_t depth;
} box_edge;

/* The edges of all boxes of a scene, sorted by the line on which they lie. */
typedef struct edge_boxes {
    const scene *scene; /* the scene, from project_scene_to_samples(); must outlive this struct */
    box_edge *items;
    size_t count;
} edge_boxes;

/* List and sort the edges of all boxes of a scene. Returns false if memory runs out. */
bool edge_boxes_collect_edges(edge_boxes *all, const scene *s);
void edge_boxes_release(edge_boxes *all);

/* Returns the index of the box that gives the merged edge `e` its colour at sample (x, y). */
size_t edge_boxes_find_owner(const edge_boxes *all, const edge *e, int x, int y);

/* Visit all boxes that have an edge where the merged edge `e` passes through sample (x, y). These include the box that
 * gives the merged edge its colour there. A box may be visited twice. */
void edge_boxes_visit_sharing(const edge_boxes *all, const edge *e, int x, int y,
                              void (*visit)(size_t box, void *context), void *context);

#endif
