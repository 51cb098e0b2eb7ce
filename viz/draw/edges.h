/* edges.h - the edges of a scene's boxes, each once, as maximal segments. Private. */
#ifndef DRAW_EDGES_H
#define DRAW_EDGES_H

#include "lines.h"
#include "scene.h"

/* A stretch of a line of the world that has one colour. */
typedef struct edge {
    double ends[2][3];
    uint64_t id; /* of the shallowest box that it belongs to; of several that meet end to end, the first one's */
    scene_look look;
    uint8_t depth;
} edge;

typedef struct edge_list {
    edge *items;
    size_t count, room;
    line_set lines;   /* while they are merged */
    scene_box *boxes; /* what was merged last: the same again need not be */
    size_t box_count, box_room;
} edge_list;

void edges_release(edge_list *list);

/* Fill a list with the edges of all boxes of the layers [first, behind). Where boxes of one layer, style and width
 * share a stretch, the shallowest gives it its colour; stretches of one depth and colour that meet are one. They come
 * by layer, style, width and axis, and then by where their lines are. False when there is no memory. Cost: O(n log n)
 * for n boxes, and O(n) where they are those of the last time. */
bool edges_merge(edge_list *list, const scene *s, unsigned first, unsigned behind);

#endif
