/* canvas.h - the quads of a frame become its indices, by way of a rasteriser and past it. For this folder.
 *
 * A rasteriser has something to decide on a slanted edge, and nothing on an upright rectangle: where many of these
 * follow each other, as points and letters do, they are filled here. And what a frame begins with that the last one
 * began with too, as the tree's boxes do under a still camera, is not drawn again: its pixels are kept. Both give the
 * same pixels as the rasteriser alone.
 */
#ifndef DRAW_CANVAS_H
#define DRAW_CANVAS_H

#include "error.h"
#include "quads.h"

/* Draw quads over a ground of one index; the rows [first, end) of the result go to `indices`, where row `first` would
 * be in a whole picture. */
typedef bool rasteriser(void *context, const quad *quads, size_t count, uint8_t ground, int first, int end,
                        uint8_t *indices, octreel_error *error);

/* A zeroed one with a size is empty. */
typedef struct canvas {
    int width, height;
    uint8_t *over;     /* what is drawn by itself and laid over what is there */
    quad_list last;    /* the quads of the last frame, */
    uint8_t *kept;     /* and the pixels of its first kept_count quads */
    size_t kept_count; /* 0: nothing is kept */
} canvas;

void canvas_release(canvas *c);

/* The canvas keeps the quads and gives those of the last frame for them. False, with a sentence, when there is no
 * memory or the rasteriser fails. */
bool canvas_draw(canvas *c, quad_list *quads, rasteriser *rasterise, void *context, uint8_t *indices,
                 octreel_error *error);

#endif
