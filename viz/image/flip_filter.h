/* SPDX-License-Identifier: MIT */
/* flip_filter.h - the filters of FLIP: how the eye blurs colours, and how it finds edges and points. */
#ifndef IMAGE_FLIP_FILTER_H
#define IMAGE_FLIP_FILTER_H

/* The largest radius of a kernel, at FLIP_MOST_PIXELS_PER_DEGREE. */
#define FLIP_MOST_RADIUS 28
/* Kernels are applied in steps of this many pairs of rows. */
#define FLIP_STEP 5

/* A kernel of one dimension. Its weights at -k and k are equal or, if `odd`, weights[k] at k and -weights[k] at -k. */
typedef struct flip_kernel {
    int radius;
    float weights[FLIP_MOST_RADIUS + FLIP_STEP]; /* from index radius + 1 on they are 0 */
} flip_kernel;

typedef struct flip_kernels {
    flip_kernel luminance, red_green, blue_yellow[2]; /* a two-dimensional filter is the product of a kernel in x and
                                                         the same kernel in y; blue_yellow is a sum of two products */
    flip_kernel smooth, edge, point; /* a Gaussian, its first derivative, which is odd, and its second derivative */
    int reach; /* the largest radius, rounded up to a multiple of FLIP_STEP: as many rows the filters read above and
                  below the middle row */
} flip_kernels;

/* Compute the kernels for a resolution in pixels per degree. */
flip_kernels flip_make_kernels(double pixels_per_degree);

/* Apply a kernel to rows of `count` floats: middle[k] is the k-th row after the middle row, k from -reach to reach. The
 * results of filter_even_add() are added to `out`. The last two functions apply two kernels to the same rows; of two
 * even ones, the first must have the larger radius. The rows may overlap each other, but not the results. */
void filter_even(const flip_kernel *even, const float *const *middle, int count, float *restrict out);
void filter_even_add(const flip_kernel *even, const float *const *middle, int count, float *restrict out);
void filter_two_even(const flip_kernel *large, const flip_kernel *small, const float *const *middle, int count,
                     float *restrict out_large, float *restrict out_small);
void filter_even_and_odd(const flip_kernel *even, const flip_kernel *odd, const float *const *middle, int count,
                         float *restrict out, float *restrict out_odd);

#endif
