/* SPDX-License-Identifier: MIT */
/* paint.h - a scene as flat quads in painter's order: the whole picture, before any GL. For this folder. */
#ifndef DRAW_PAINT_H
#define DRAW_PAINT_H

#include "edges.h"
#include "project.h"
#include "quads.h"
#include "splats.h"

/* Data that is reused from frame to frame. Empty when zeroed. */
typedef struct painter {
    quad_list quads;
    edge_list tree,
        edges;        /* of the world and the nodes, which often stay the same from tick to tick; and of other layers */
    uint8_t *nearest; /* a byte a sample: 1 + the nearest band of a point there, while points are folded */
    size_t pixels;
    point_place *places; /* where each point is drawn */
    size_t place_room;
    splats splats;           /* points that are painted one by one */
    size_t overflowed;       /* elements of the last scene that are too far away for doubles, and so not drawn */
    struct painter *closeup; /* of the scene's close-up; null until there is one */
} painter;

void painter_release(painter *p);

/* Fill p->quads with a scene. False when there is no memory. */
bool paint(painter *p, const scene *picture);

/* The merged edges that are painted: quads of boxes have their indices, from 0 to paint_edge_count() - 1. */
size_t paint_edge_count(const painter *p);
const edge *paint_edge_at(const painter *p, size_t index);

/* The index of the sample that a point lies on, and its band; points at one sample share a quad. False for other
 * markers and outside the picture. `s` is in samples. */
bool paint_point_pixel(const scene *s, const scene_marker *marker, size_t *place, unsigned *band);

#endif
