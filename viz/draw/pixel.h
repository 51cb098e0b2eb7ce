/* pixel.h - what is drawn where: at each sample, at one pixel, and by which layers. */
#ifndef DRAW_PIXEL_H
#define DRAW_PIXEL_H

#include "renderer.h"

/* Draw a scene as renderer_draw() does, the same quads in the same order; but in place of its colour each sample gets
 * the number (scene_number_of) of the element that was painted there last. Where boxes share an edge that is the
 * shallowest of those which are there; where points share a quad, the one it was painted for: renderer_pixel() names
 * them all. */
bool renderer_pick(renderer *r, const scene *s, uint32_t *numbers, octreel_error *error);

/* Where a set of layers (bits 1 << view_layer, LAYER_DIAGRAM too) is seen in a scene's picture: a byte a pixel, 1 where
 * an element of theirs is on top at any of the pixel's samples, else 0. Without these layers no other pixel would be
 * different. */
bool renderer_layer_mask(renderer *r, const scene *s, unsigned layers, uint8_t *mask, octreel_error *error);

/* What an element has to do with a pixel, which is view_samples() squared samples. */
typedef struct draw_touch {
    uint32_t number;
    int shown;     /* samples at which it is seen: nothing was painted over it */
    int painted;   /* samples that were painted for it; 0: it is there by the quad of the one before it in the list, a
                      box that has the same edge there, or a point of the same pixel */
    uint16_t at;   /* which samples were painted: a bit for each, row by row */
    uint8_t color; /* index of the theme's table that was painted last; 0 also in the gaps of what is cut */
} draw_touch;

typedef struct draw_touches {
    draw_touch *items;
    size_t count, room;
} draw_touches;

void draw_touches_release(draw_touches *list);

/* Fill a list with all elements of a pixel of the picture, from the one on top to the one beneath all others: also
 * those that others cover. A zeroed list is an empty one. */
bool renderer_pixel(renderer *r, const scene *s, int x, int y, draw_touches *list, octreel_error *error);

#endif
