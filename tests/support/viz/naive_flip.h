/* SPDX-License-Identifier: MIT */
/* naive_flip.h - FLIP as the formulae of the paper have it: two-dimensional filters, doubles and the C library's
 * functions. Slow: K * K products a pixel. */
#ifndef SUPPORT_NAIVE_FLIP_H
#define SUPPORT_NAIVE_FLIP_H

#include "image.h"

/* The value of each pixel of two RGB or indexed images of equal size; the caller frees the array. */
double *naive_flip(const image *a, const image *b, double pixels_per_degree);

/* The largest difference of two sRGB colours, that of green and blue, to the power of 0.7. */
double naive_flip_largest_difference(void);

#endif
