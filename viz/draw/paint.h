/* SPDX-License-Identifier: MIT */
/* paint.h - turns a scene into quads in painter's order, which a rasterizer then fills. Private to this folder. */
#ifndef DRAW_PAINT_H
#define DRAW_PAINT_H

#include "edges.h"
#include "project.h"
#include "quads.h"
#include "splats.h"

/* Buffers that are reused from frame to frame. A zeroed struct is empty. */
typedef struct painter {
    quad_list quads;
    /* merged edges of the boxes of the world and of nodes; these boxes often stay the same from tick to tick */
    edge_list tree;
    edge_list edges;  /* merged edges of the boxes in all other layers */
    uint8_t *nearest; /* for each sample: 1 + the band of the nearest point at the sample; 0: no point */
    size_t nearest_room;
    point_place *places; /* for each marker: the sample at which the marker is drawn */
    size_t place_room;
    splats splats;
    size_t overflowed;       /* the number of segments of the last scene whose camera coordinates overflow a double */
    struct painter *closeup; /* paints the scene's close-up; null until a scene has one */
} painter;

void painter_release(painter *p);

/* Fill p->quads with the quads of a scene, in painter's order. Returns false if memory runs out. */
bool painter_paint_scene(painter *p, const scene *picture);

/* The merged edges of the scene's boxes. In a quad of a box, quad.index is the index of a merged edge, from 0 to
 * painter_edge_count() - 1. */
size_t painter_edge_count(const painter *p);
const edge *painter_edge_at(const painter *p, size_t index);

#endif
