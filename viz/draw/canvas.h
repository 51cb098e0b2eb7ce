/* SPDX-License-Identifier: MIT */
/* canvas.h - fills the quads of a frame, but not again those that it begins with as the last frame did, as the tree's
 * boxes under a still camera: their pixels are kept. For this folder. */
#ifndef DRAW_CANVAS_H
#define DRAW_CANVAS_H

#include "quads.h"

/* Empty when all but the size is zero. */
typedef struct canvas {
    int width, height;
    quad_list last;    /* the quads of the last frame */
    uint8_t *kept;     /* the pixels of its first kept_count quads */
    size_t kept_count; /* 0: nothing is kept */
} canvas;

void canvas_release(canvas *c);

/* Fill quads on a ground of zeros; returns how many were not kept. The canvas takes the quads, and gives back those of
 * the last frame. */
size_t canvas_draw(canvas *c, quad_list *quads, uint8_t *indices);

#endif
