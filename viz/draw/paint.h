/* paint.h - a scene as flat quads in painter's order: all that the picture is, before any GL. Private to draw. */
#ifndef DRAW_PAINT_H
#define DRAW_PAINT_H

#include "edges.h"
#include "quads.h"

/* What is reused from frame to frame. A zeroed painter is an empty one. */
typedef struct painter {
    quad_list quads;
    edge_list edges;
    uint8_t *nearest; /* a byte a sample: 1 + the nearest band of a point there, while points are folded */
    size_t pixels;
    size_t overflowed; /* elements of the last scene that are too far off for doubles: counted, not drawn */
} painter;

void painter_release(painter *p);

/* Fill p->quads with a scene. False when there is no memory. */
bool paint(painter *p, const scene *picture);

#endif
