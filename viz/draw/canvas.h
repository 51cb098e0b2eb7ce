/* SPDX-License-Identifier: MIT */
/* canvas.h - fills the quads of a frame with the integer rasterizer. Where a frame begins with the same quads as the
 * last one, for example the tree's boxes under a still camera, their pixels are copied instead. Private to this folder.
 */
#ifndef DRAW_CANVAS_H
#define DRAW_CANVAS_H

#include "quads.h"

/* Empty when everything but the size is zero. */
typedef struct canvas {
    int width, height;
    quad_list last;    /* the quads of the last frame */
    uint8_t *kept;     /* the picture of the first kept_count quads of `last` alone */
    size_t kept_count; /* 0: no picture is kept */
} canvas;

void canvas_release(canvas *c);

/* Fill quads on a background of zeros. Returns the number of quads that were filled rather than copied. Swaps the list
 * with c->last, so that afterwards c->last holds these quads and `quads` the buffers of the last frame. */
size_t canvas_draw(canvas *c, quad_list *quads, uint8_t *indices);

#endif
