/* SPDX-License-Identifier: MIT */
/* pixel.h - finds the elements that are drawn at each sample, at one pixel, and by some layers. */
#ifndef DRAW_PIXEL_H
#define DRAW_PIXEL_H

#include "array.h"
#include "renderer.h"

/* Write to each sample of the picture the number (scene_element_number) of its topmost element; 0: none. Where boxes
 * share an edge, it is the shallowest box. Where points share a quad, it is the point for which the quad was painted.
 * renderer_list_pixel_covers() lists all elements. */
bool renderer_find_element_numbers(renderer *r, const scene *s, uint32_t *numbers, octreel_error *error);

/* Find the pixels at which some layers are visible. `layers` has bits 1 << view_layer, also for LAYER_DIAGRAM. The mask
 * has one byte per pixel: 1 if an element of these layers is on top at any sample of the pixel, else 0. Hiding these
 * layers would change no pixel whose byte is 0. */
bool renderer_find_layer_mask(renderer *r, const scene *s, unsigned layers, uint8_t *mask, octreel_error *error);

/* An element at a pixel, and the samples of the pixel that it covers. */
typedef struct draw_cover {
    uint32_t number;
    int shown;   /* the number of the pixel's samples at which the element is on top */
    int painted; /* The number of the pixel's samples that the element's quads cover. 0: a point hidden by other points,
                    or an element without a quad of its own, such as a box that shares an edge or a point that shares a
                    sample with an earlier entry */
    uint16_t at; /* the samples that the element's quads cover, one bit each, row by row */
    uint8_t color; /* the element's colour at the pixel, an index of the theme's table; 0 also in gaps of STROKE_CUT */
} draw_cover;

typedef ARRAY(draw_cover) draw_covers;

void draw_covers_release(draw_covers *list);

/* Fill a list with all elements at pixel (x, y), from top to bottom, including hidden elements. A zeroed list is
 * empty. */
bool renderer_list_pixel_covers(renderer *r, const scene *s, int x, int y, draw_covers *list, octreel_error *error);

#endif
