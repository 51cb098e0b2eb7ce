/* SPDX-License-Identifier: MIT */
/* pixel.h - which elements are drawn where: at each sample, at one pixel, and by which layers. */
#ifndef DRAW_PIXEL_H
#define DRAW_PIXEL_H

#include "renderer.h"

/* Draw a scene as renderer_draw() does, but write to each sample the number (scene_number_of) of the element on top in
 * place of its colour. If boxes share an edge there, that is the shallowest; if points share a quad, the one that it
 * was painted for. renderer_pixel() lists them all. */
bool renderer_pick(renderer *r, const scene *s, uint32_t *numbers, octreel_error *error);

/* Where a set of layers (bits 1 << view_layer, LAYER_DIAGRAM too) is visible in a scene's picture: a byte per pixel, 1
 * where one of their elements is on top at any of the pixel's samples, else 0. Hiding these layers would change no
 * other pixel. */
bool renderer_layer_mask(renderer *r, const scene *s, unsigned layers, uint8_t *mask, octreel_error *error);

/* How an element covers a pixel of view_samples() squared samples. */
typedef struct draw_touch {
    uint32_t number;
    int shown;     /* samples at which it is on top */
    int painted;   /* samples that its quads cover; 0: it shares the quad of an element before it in the list, as a box
                      with the same edge or a point at the same sample; or it is a painted point that others hide */
    uint16_t at;   /* these samples as bits, row by row */
    uint8_t color; /* index of the theme's table that is painted there; 0 also in gaps of STROKE_CUT */
} draw_touch;

typedef struct draw_touches {
    draw_touch *items;
    size_t count, room;
} draw_touches;

void draw_touches_release(draw_touches *list);

/* Fill a list with all elements at a pixel, from top to bottom, hidden ones included. Empty when zeroed. */
bool renderer_pixel(renderer *r, const scene *s, int x, int y, draw_touches *list, octreel_error *error);

#endif
