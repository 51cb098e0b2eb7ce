/* SPDX-License-Identifier: MIT */
/* clip.h - keeps quads in a square, so that nothing that fills them has to clip: GL would, in single precision; those
 * of a close-up in its rectangle. For this folder. */
#ifndef DRAW_CLIP_H
#define DRAW_CLIP_H

#include "quads.h"

/* The pixels on each side of the square that a picture's quads are kept in: the least power of two that holds it. */
int clip_square(int width, int height);

#define CLIP_PIECES 3

/* The part of a convex quad within [0, limits[axis]] on each axis, as 0 to CLIP_PIECES quads that share no pixel; new
 * corners are rounded to 1/256 pixel. Upright rectangles may be anywhere, other quads within 2^28 of 0. */
int clip_quad(const quad *q, const int32_t limits[2], quad pieces[CLIP_PIECES]);

#endif
