/* edge_boxes.h - which boxes of a scene lie on one of its merged edges. Private.
 *
 * An edge is one stroke for all boxes that share it. This asks the scene which they are, at one sample of that stroke.
 */
#ifndef DRAW_EDGE_BOXES_H
#define DRAW_EDGE_BOXES_H

#include "edges.h"

/* One edge of one box. */
typedef struct box_edge box_edge;

/* Those of all boxes of a scene, sorted by the lines that they lie on. */
typedef struct edge_boxes {
    const scene *scene; /* in samples; as long as this is in use */
    box_edge *items;
    size_t count;
} edge_boxes;

/* False when there is no memory. Cost: O(n log n) for n boxes. */
bool edge_boxes_make(edge_boxes *all, const scene *s);
void edge_boxes_release(edge_boxes *all);

/* The box that gives an edge of edges_merge() its colour at a sample: its index in the scene. */
size_t edge_boxes_giver(const edge_boxes *all, const edge *e, int x, int y);

/* All boxes that have an edge where this one passes through a sample, the giver among them; some twice. */
void edge_boxes_visit(const edge_boxes *all, const edge *e, int x, int y, void (*visit)(size_t box, void *context),
                      void *context);

#endif
