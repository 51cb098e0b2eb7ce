/* SPDX-License-Identifier: MIT */
/* pixel.h - finds the elements that are drawn at each sample, at one pixel, and by some layers. */
#ifndef DRAW_PIXEL_H
#define DRAW_PIXEL_H

#include "array.h"
#include "renderer.h"

/* Draw a scene as renderer_draw_scene() does, but write to each sample the number (scene_element_number) of its topmost
 * element; 0: none. Of boxes that share an edge it is the shallowest; of points that share a quad, the point for which
 * the quad was painted. renderer_list_pixel_covers() lists all of them. */
bool renderer_find_element_numbers(renderer *r, const scene *s, uint32_t *numbers, octreel_error *error);

/* Find the pixels at which some layers (bits 1 << view_layer, LAYER_DIAGRAM too) are visible. A byte per pixel: 1 where
 * one of their elements is on top at any sample of the pixel, else 0. Hiding these layers would change no other pixel.
 */
bool renderer_find_layer_mask(renderer *r, const scene *s, unsigned layers, uint8_t *mask, octreel_error *error);

/* How an element covers a pixel. */
typedef struct draw_cover {
    uint32_t number;
    int shown;     /* the number of samples at which it is on top */
    int painted;   /* the number of samples that its quads cover. 0: it shares the quad of an element before it in the
                      list, such as a box with the same edge or a point at the same sample, or it is a point that other
                      points hide */
    uint16_t at;   /* the samples that its quads cover, as bits, row by row */
    uint8_t color; /* its colour there, an index of the theme's table; 0 also in gaps of STROKE_CUT */
} draw_cover;

typedef ARRAY(draw_cover) draw_covers;

void draw_covers_release(draw_covers *list);

/* Fill a list with all elements at a pixel, from top to bottom, including hidden ones. A zeroed list is empty. */
bool renderer_list_pixel_covers(renderer *r, const scene *s, int x, int y, draw_covers *list, octreel_error *error);

#endif
