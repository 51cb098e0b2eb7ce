/* SPDX-License-Identifier: MIT */
/* pixel.h - finds which elements are drawn: at every sample of a picture, at a given pixel, or by given layers. */
#ifndef DRAW_PIXEL_H
#define DRAW_PIXEL_H

#include "array.h"
#include "renderer.h"

/* Write one number for each sample of the picture: the number (scene_element_number) of the topmost element at the
 * sample, or 0 if there is no element. Where boxes share an edge, the topmost element is the shallowest box. Where
 * points share a quad, the topmost element is the point for which the quad was painted. renderer_list_pixel_covers()
 * lists the other elements too. */
bool renderer_find_element_numbers(renderer *r, const scene *s, uint32_t *numbers, octreel_error *error);

/* Find the pixels at which some layers are visible. `layers` has bits 1 << view_layer, also for LAYER_DIAGRAM. The mask
 * has one byte per pixel. The byte is 1 if an element of these layers is the topmost element of some sample of the
 * pixel; otherwise it is 0. Hiding these layers would change no pixel whose byte is 0. */
bool renderer_find_layer_mask(renderer *r, const scene *s, unsigned layers, uint8_t *mask, octreel_error *error);

/* An element at a pixel, and the samples of the pixel that the element covers. */
typedef struct draw_cover {
    uint32_t number;
    int shown; /* the number of the pixel's samples at which the element is the topmost element */
    /* The number of the pixel's samples that the element's quads cover; 0 for a point hidden by other points, and for
     * an element without a quad of its own: a box that shares another box's edge, or a point that shares the sample of
     * an earlier entry. */
    int painted;
    uint16_t at; /* the samples that the element's quads cover, one bit each, row by row */
    /* the element's colour at the pixel, as an index of the theme's table; 0 also in gaps of STROKE_CUT */
    uint8_t color;
} draw_cover;

typedef ARRAY(draw_cover) draw_covers;

void draw_covers_release(draw_covers *list);

/* Fill a list with all elements at pixel (x, y), from the topmost to the lowest, including hidden elements. A zeroed
 * list is empty. */
bool renderer_list_pixel_covers(renderer *r, const scene *s, int x, int y, draw_covers *list, octreel_error *error);

#endif
