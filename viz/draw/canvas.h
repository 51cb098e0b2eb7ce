/* canvas.h - the quads of a frame become its indices, by way of a rasteriser and past it. Private.
 *
 * A rasteriser has something to decide on a slanted edge, and nothing on an upright rectangle: where many of these
 * follow each other, as points and letters do, they are filled here. And what a frame begins with that the last one
 * began with too, as the tree's boxes do under a still camera, is not drawn again: its pixels are kept. Both give the
 * same pixels as the rasteriser alone.
 */
#ifndef DRAW_CANVAS_H
#define DRAW_CANVAS_H

#include "quads.h"

/* Draw quads over a ground of one index; the rows [first, end) of the result go to `indices`, where row `first` would
 * be in a whole picture. */
typedef bool rasteriser(void *context, const quad *quads, size_t count, uint8_t ground, int first, int end,
                        uint8_t *indices);

/* A zeroed one with a size is empty. */
typedef struct canvas {
    int width, height;
    uint8_t *over;     /* what is drawn by itself and laid over what is there */
    quad_list last;    /* the quads of the last frame, */
    uint8_t *kept;     /* and the pixels of the first few of them */
    size_t kept_count; /* so many; 0 is none */
} canvas;

void canvas_release(canvas *c);

/* False when there is no memory or the rasteriser fails. */
bool canvas_draw(canvas *c, const quad_list *quads, rasteriser *rasterise, void *context, uint8_t *indices);

#endif
