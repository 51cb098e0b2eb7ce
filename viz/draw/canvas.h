/* SPDX-License-Identifier: MIT */
/* canvas.h - turns the quads of a frame into colour indices, with as little work for the rasteriser as possible. For
 * this folder.
 *
 * Long runs of upright rectangles, such as points and letters, are filled here: only slanted edges need a rasteriser.
 * And the quads at the start of a frame that are the same as in the last frame, as the tree's boxes under a still
 * camera, are not drawn again: their pixels are kept. Both give the same pixels as the rasteriser alone.
 */
#ifndef DRAW_CANVAS_H
#define DRAW_CANVAS_H

#include "error.h"
#include "quads.h"

/* Draw quads over a background of one index, and write the rows [first, end) of the result to their places in
 * `indices`, a whole picture. */
typedef bool rasteriser(void *context, const quad *quads, size_t count, uint8_t ground, int first, int end,
                        uint8_t *indices, octreel_error *error);

/* Empty when all but the size is zero. */
typedef struct canvas {
    int width, height;
    uint8_t *over;     /* quads that are drawn separately, before they are laid over a picture */
    quad_list last;    /* the quads of the last frame */
    uint8_t *kept;     /* the pixels of its first kept_count quads */
    size_t kept_count; /* 0: nothing is kept */
} canvas;

void canvas_release(canvas *c);

/* The canvas keeps the quads, and exchanges them for those of the last frame. False, with a sentence, when there is no
 * memory or the rasteriser fails. */
bool canvas_draw(canvas *c, quad_list *quads, rasteriser *rasterise, void *context, uint8_t *indices,
                 octreel_error *error);

#endif
