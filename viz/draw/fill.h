/* fill.h - quads that leave a rasteriser nothing to decide, filled by the rule that GL states and llvmpipe keeps.
 *
 * Corners are whole 1/256 pixels, so that whether a pixel's centre is in a quad is a question of integers. A pixel
 * belongs to what its centre is in; a centre on an edge belongs to the quad that has the edge on its left, or, where
 * the edge is level, on its top.
 */
#ifndef DRAW_FILL_H
#define DRAW_FILL_H

#include "quads.h"

typedef struct fill_target {
    uint8_t *indices;
    int width, height;
} fill_target;

/* Upright rectangles; and lines as they are stroked, parallelograms with two sides along an axis, as long as a whole
 * number of pixels. These must lie in the picture: GL clips what reaches beyond it, in single precision. */
bool fill_takes(const fill_target *to, const quad *q);

void fill_quad(const fill_target *to, const quad *q);

#endif
