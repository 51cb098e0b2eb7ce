/* rasterise.h - quads through a renderer's context, whatever their colours stand for. Private. */
#ifndef DRAW_RASTERISE_H
#define DRAW_RASTERISE_H

#include "quads.h"

/* Whether a scene's picture has the renderer's size in samples; a sentence where it has not. */
bool renderer_fits(const renderer *r, const scene *s, octreel_error *error);

/* Draw quads in this order on nothing but zeros, and read the bytes of a part of what is drawn; it lies within it. */
bool renderer_rasterise(renderer *r, const quad *quads, size_t count, const draw_box *part, uint8_t *bytes,
                        octreel_error *error);

#endif
