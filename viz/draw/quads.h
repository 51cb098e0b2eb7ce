/* SPDX-License-Identifier: MIT */
/* quads.h - the flat quads that a scene is painted with, in painter's order. For this folder.
 *
 * Coordinates are in 1/256 pixel, y down, snapped. Visibility is decided here, not by GL: layers in their
 * order; within a layer eight bands of view depth, far to near; within a band deeper nodes first.
 */
#ifndef DRAW_QUADS_H
#define DRAW_QUADS_H

#include "scene.h"

#define QUAD_SUBPIXELS 256
#define QUAD_IN_CLOSEUP SCENE_KINDS

typedef struct quad {
    int32_t x[4], y[4];
    uint8_t color;  /* an index of the theme's table */
    uint8_t kind;   /* scene_kind of the element that it is a part of; QUAD_IN_CLOSEUP more in a close-up */
    uint16_t order; /* smaller is painted first */
    uint32_t index; /* of that element; of a box, that of the edge in the painter's list instead */
} quad;

typedef struct quad_list {
    quad *items;
    size_t count, room;
    bool out_of_memory;
    int32_t limits[2]; /* quads are clipped to [0, limits[axis]] on each axis; 0: nowhere */
    uint8_t kind;      /* of the element whose quads are being added */
    uint32_t index;
} quad_list;

void quads_release(quad_list *list);

/* Quads added from now on are parts of this element. */
static inline void quads_begin(quad_list *list, scene_kind kind, size_t index)
{
    list->kind = (uint8_t)kind;
    list->index = (uint32_t)index;
}

/* Convex quads only. */
void quads_add(quad_list *list, const quad *q);

/* Put the quads of a close-up above the world and its frame, and below what comes after them, moved by subpixels. Both
 * lists are sorted. False when there is no memory. */
bool quads_put_closeup(quad_list *list, const quad_list *closeup, const int32_t by[2]);

/* Stable, by order. False when there is no memory. */
bool quads_sort(quad_list *list);

/* The order of a layer's element in a band (0 is nearest) and at a node's depth. */
uint16_t quad_order(unsigned layer, unsigned band, unsigned depth);

#define QUAD_BANDS THEME_SHADES

/* The order of letters and of panels, which have no depth: last in their layer; but those of the axes lie above nodes
 * and points, and those of nodes above these and velocities. */
uint16_t quad_order_of_text(unsigned layer);

#endif
