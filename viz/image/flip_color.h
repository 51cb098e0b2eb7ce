/* SPDX-License-Identifier: MIT */
/* flip_color.h - the arithmetic of FLIP on rows of pixels: from samples to an opponent colour space, from there to a
 * uniform colour space, and from the differences of colours and features to the value of a pixel. */
#ifndef IMAGE_FLIP_COLOR_H
#define IMAGE_FLIP_COLOR_H

#include "samples.h"

/* The longest row that the functions of this file process, in pixels. */
#define FLIP_STRIP 256

/* Colours as three numbers: luminance, red-green and blue-yellow. With X, Y, Z divided by those of white they are Y,
 * X - Y and Y - Z. (In the space YCxCz of the authors these are scaled by 116, 500 and 200 and Y is shifted by -16,
 * which no filter changes.) */
typedef struct flip_opponent {
    float y[FLIP_STRIP], x[FLIP_STRIP], z[FLIP_STRIP];
} flip_opponent;

/* Colours as L* and the products of a* and b* with 0.01 L*: the adjustment of Hunt. */
typedef struct flip_lab {
    float l[FLIP_STRIP], a[FLIP_STRIP], b[FLIP_STRIP];
} flip_lab;

/* Fill a table of range + 1 entries that turns an sRGB sample into linear light from 0 to 1. */
void flip_fill_linear_table(int range, float *table);

/* Convert `count` samples to the three numbers of flip_opponent; `table` is from flip_fill_linear_table(). */
void flip_convert_samples(const pixel_samples *samples, const float *table, int count, float *restrict y,
                          float *restrict x, float *restrict z);

/* Convert blurred opponent colours to Lab. Colours outside of sRGB are clipped. The colours are overwritten. */
void flip_convert_to_lab(flip_opponent *colors, int count, flip_lab *restrict to);

/* Compute the value of `count` pixels from 0 to 1. features[0] and [1] are the strengths of edges and points of the
 * first image, from 0 to sqrt(2), features[2] and [3] those of the second image. */
void flip_combine(const flip_lab colors[2], float features[4][FLIP_STRIP], int count, float *restrict values);

/* Store the length of the vectors (x, y) in x. */
void flip_find_lengths(float *restrict x, const float *y, int count);

#endif
