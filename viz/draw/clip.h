/* SPDX-License-Identifier: MIT */
/* clip.h - clips quads to a rectangle, so that rasterizers need not: GL would clip in single precision, with other
 * pixels. Private to this folder. */
#ifndef DRAW_CLIP_H
#define DRAW_CLIP_H

#include "quads.h"

/* The side of the square to which the quads of a picture are clipped: the least power of two that holds the picture. */
int clip_square(int width, int height);

#define CLIP_PIECES 3

/* Clip a convex quad to [0, limits[axis]] on each axis. Writes 0 to CLIP_PIECES quads that share no pixel and returns
 * their number. New corners are rounded to 1/256 pixel. Axis-aligned rectangles may have any coordinates, other quads
 * coordinates within 2^28 of 0. */
int clip_quad(const quad *q, const int32_t limits[2], quad pieces[CLIP_PIECES]);

#endif
