/* edges.h - the edges of a scene's boxes, each once, as maximal segments. Private. */
#ifndef DRAW_EDGES_H
#define DRAW_EDGES_H

#include "box_lines.h"
#include "scene.h"

/* A stretch of a line of the world that has one colour. */
typedef struct edge {
    double ends[2][3];
    uint64_t id; /* of the shallowest box that it belongs to; of several that meet end to end, the first one's */
    scene_style style;
    uint8_t depth;
} edge;

typedef struct edge_list {
    edge *items;
    size_t count, room;
    merged_boxes boxes; /* what was merged last: the same again need not be */
    line_set lines;     /* that their edges lie on, */
    uint32_t *order;    /* and the places of those in the order of painting; */
    size_t ordered;     /* so many, the first ones: those that came last are not among them yet */
    edge *before;       /* the edges of the last time, while they are merged */
    size_t before_room;
} edge_list;

void edges_release(edge_list *list);

/* Fill a list with the edges of all boxes of the layers [first, behind). Where boxes of one layer, style and width
 * share a stretch, the shallowest gives it its colour; stretches of one depth and colour that meet are one. They come
 * by layer, style, width and axis, and then by where their lines are. False when there is no memory. Cost: O(n log n)
 * for n boxes; where most are those of the last time, O(n) and the lines of the others, and where all are, O(n). */
bool edges_merge(edge_list *list, const scene *s, unsigned first, unsigned behind);

#endif
