/* SPDX-License-Identifier: MIT */
/* quads.h - a list of quads, each with one colour, sorted in painter's order. Private to this folder.
 *
 * Coordinates are integers in units of 1/256 pixel; y points down. Later quads cover earlier quads. Quads are ordered
 * by layer. Within a layer they are ordered by eight bands of view depth, from far to near. Within a band they are
 * ordered by the depth of their node in the tree, deeper nodes first. */
#ifndef DRAW_QUADS_H
#define DRAW_QUADS_H

#include "scene.h"

#define QUAD_SUBPIXELS 256
#define QUAD_IN_CLOSEUP SCENE_KINDS

typedef struct quad {
    int32_t x[4], y[4];
    uint8_t color;  /* an index into the theme's table of colours */
    uint8_t kind;   /* the scene_kind of the quad's element; QUAD_IN_CLOSEUP is added if the element is in a close-up */
    uint16_t order; /* quads with a lower order are painted first */
    uint32_t index; /* index of the quad's element; for a box, the index of a merged edge (painter_edge_at()) */
} quad;

typedef struct quad_list {
    quad *items;
    size_t count, room;
    bool out_of_memory;
    int32_t limits[2]; /* quads are clipped to [0, limits[axis]] on each axis; if limits[0] is 0, quads are not
                        * clipped */
    uint8_t kind;      /* kind and index of the element whose quads are being added */
    uint32_t index;
} quad_list;

void quads_release(quad_list *list);

/* Set the element to which all quads that are added from now on belong. */
static inline void quads_begin_element(quad_list *list, scene_kind kind, size_t index)
{
    list->kind = (uint8_t)kind;
    list->index = (uint32_t)index;
}

/* Add a convex quad. If memory runs out, list->out_of_memory becomes true. */
void quads_add_quad(quad_list *list, const quad *q);

/* Set the corners of *q to the corners of a rectangle, in subpixels, and add *q to the list. */
void quads_add_rectangle(quad_list *list, quad *q, int32_t left, int32_t top, int32_t right, int32_t bottom);

/* Insert the quads of a close-up, moved by `by` subpixels, after all quads of the layers up to LAYER_CLOSEUP. Both
 * lists must be sorted. Returns false if memory runs out. */
bool quads_insert_closeup(quad_list *list, const quad_list *closeup, const int32_t by[2]);

/* Sort quads by `order`. The sort is stable. Returns false if memory runs out. Cost: O(n), by a counting sort. */
bool quads_sort(quad_list *list);

/* Returns quad.order for an element of a layer, at a band of view depth (0 is the nearest), that belongs to a node at
 * `depth` in the tree. */
uint16_t make_quad_order(unsigned layer, unsigned band, unsigned depth);

#define QUAD_BANDS THEME_SHADES

/* Returns quad.order for text and panels, which have no view depth and come last in their layer. Text of the axes is
 * painted after nodes and points, text of nodes after points and velocities, and ranks of neighbours after the
 * player. */
uint16_t make_text_order(unsigned layer);

/* ---- clip.c --------------------------------------------------------------------------------------------------- */

/* Returns the side of the square to which the quads of a picture are clipped: the least power of two that is at least
 * the picture's width and height. */
int enclosing_power_of_two(int width, int height);

#define CLIP_PIECES 3

/* Clip a convex quad to [0, limits[axis]] on each axis. Writes up to CLIP_PIECES quads that do not overlap, and returns
 * their number. New corners are rounded to 1/256 pixel. Axis-aligned rectangles may have any coordinates; coordinates
 * of other quads must be within 2^28 of 0. */
int clip_quad(const quad *q, const int32_t limits[2], quad pieces[CLIP_PIECES]);

#endif
