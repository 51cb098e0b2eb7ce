/* SPDX-License-Identifier: MIT */
/* quads.h - a list of quads, each with one colour, sorted in painter's order. Private to this folder.
 *
 * Coordinates are whole numbers of 1/256 pixel, y down. Later quads cover earlier ones. They are ordered by layer; in a
 * layer by eight bands of view depth, far to near; in a band deeper nodes come first.
 */
#ifndef DRAW_QUADS_H
#define DRAW_QUADS_H

#include "scene.h"

#define QUAD_SUBPIXELS 256
#define QUAD_IN_CLOSEUP SCENE_KINDS

typedef struct quad {
    int32_t x[4], y[4];
    uint8_t color;  /* an index of the theme's table */
    uint8_t kind;   /* scene_kind of its element, plus QUAD_IN_CLOSEUP in a close-up */
    uint16_t order; /* quads with a lower order are painted first */
    uint32_t index; /* of its element; for boxes, the index of the merged edge: see painter_edge_at() */
} quad;

typedef struct quad_list {
    quad *items;
    size_t count, room;
    bool out_of_memory;
    int32_t limits[2]; /* quads are clipped to [0, limits[axis]] on each axis; 0: not clipped */
    uint8_t kind;      /* kind and index of the element whose quads are being added */
    uint32_t index;
} quad_list;

void quads_release(quad_list *list);

/* Quads added from now on belong to this element. */
static inline void quads_begin_element(quad_list *list, scene_kind kind, size_t index)
{
    list->kind = (uint8_t)kind;
    list->index = (uint32_t)index;
}

/* Add a convex quad. Out of memory is reported by list->out_of_memory. */
void quads_add_quad(quad_list *list, const quad *q);

/* Set the corners of a quad to those of a rectangle, in subpixels, and add it. */
void quads_add_rectangle(quad_list *list, quad *q, int32_t left, int32_t top, int32_t right, int32_t bottom);

/* Insert the quads of a close-up, moved by `by` subpixels, after all quads up to LAYER_CLOSEUP. Both lists are sorted.
 * False when out of memory. */
bool quads_insert_closeup(quad_list *list, const quad_list *closeup, const int32_t by[2]);

/* Sort by order, stably. False when out of memory. Cost: O(n), a counting sort. */
bool quads_sort(quad_list *list);

/* The order of a layer's element in a band (0 is nearest) and at a node's depth. */
uint16_t make_quad_order(unsigned layer, unsigned band, unsigned depth);

#define QUAD_BANDS THEME_SHADES

/* The order of letters and panels, which have no depth: last in their layer. Letters of axes come after nodes and
 * points, letters of nodes after points and velocities. */
uint16_t make_text_order(unsigned layer);

/* ---- clip.c --------------------------------------------------------------------------------------------------- */

/* The side of the square to which the quads of a picture are clipped: the least power of two that holds the picture. */
int clip_square_side(int width, int height);

#define CLIP_PIECES 3

/* Clip a convex quad to [0, limits[axis]] on each axis. Writes 0 to CLIP_PIECES quads that share no pixel and returns
 * their number. New corners are rounded to 1/256 pixel. Axis-aligned rectangles may have any coordinates, other quads
 * coordinates within 2^28 of 0. */
int clip_quad(const quad *q, const int32_t limits[2], quad pieces[CLIP_PIECES]);

#endif
