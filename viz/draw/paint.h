/* paint.h - a scene as flat quads in painter's order: all that the picture is, before any GL. For this
 * folder. */
#ifndef DRAW_PAINT_H
#define DRAW_PAINT_H

#include "edges.h"
#include "quads.h"

/* What is reused from frame to frame. A zeroed painter is an empty one. */
typedef struct painter {
    quad_list quads;
    edge_list tree, edges; /* of the world and its nodes, which are the same for many ticks; and of all else */
    uint8_t *nearest;      /* a byte a sample: 1 + the nearest band of a point there, while points are folded */
    size_t pixels;
    struct point_place *places; /* where each point is, meanwhile */
    size_t place_room;
    size_t overflowed; /* elements of the last scene that are too far off for doubles: counted, not drawn */
} painter;

void painter_release(painter *p);

/* Fill p->quads with a scene. False when there is no memory. */
bool paint(painter *p, const scene *picture);

/* The merged edges that are painted: quads of boxes have their indices, from 0 to paint_edge_count() - 1. */
size_t paint_edge_count(const painter *p);
const edge *paint_edge_at(const painter *p, size_t index);

/* The place of the sample that a point lies on, and its band; points of one place are one quad. False for a marker that
 * is no point, and for what is outside the picture. `s` is in samples. */
bool paint_point_pixel(const scene *s, const scene_marker *marker, size_t *place, unsigned *band);

#endif
