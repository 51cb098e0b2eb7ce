/* SPDX-License-Identifier: MIT */
/* flip_filter.c - computes the kernels of FLIP and applies them to rows.
 *
 * A picture of N pixels and a filter of K x K weights cost N K K products. All filters of FLIP are Gaussians, their
 * derivatives, or a sum of two Gaussians. Such a filter is a product of a function of x and a function of y, so that a
 * pass along the rows and a pass along the columns cost 2 N K products. The kernels are also even or odd, so that two
 * taps share a product. Both passes use the same functions: a tap is a pointer to a row, and in the pass along the rows
 * it points k floats further into the same row.
 *
 * Each sum is computed tap by tap for all pixels of a row. A compiler may then compute several pixels at once without
 * changing the order of any sum, which would change bits. Five pairs of taps are added at a time, so that the sum is
 * loaded and stored less often.
 *
 * Source of the kernels, and of the split of the sum of two Gaussians: P. Andersson and others, "FLIP: A Difference
 * Evaluator for Alternating Images", 2020. */
#include "flip_filter.h"
#include "portable_math.h"

#include <math.h>
#include <stdbool.h>

#define PI 3.14159265358979324

/* ---- Kernels ----------------------------------------------------------------------------------------------------- */

/* A contrast sensitivity function, a exp(-pi^2 x^2 / b) / sqrt(b / pi), with x in degrees. */
typedef struct sensitivity {
    double a, b;
} sensitivity;

static const sensitivity LUMINANCE = {1, 0.0047}, RED_GREEN = {1, 0.0053},
                         BLUE_YELLOW[2] = {{34.1, 0.04}, {13.5, 0.025}};
#define WIDEST 0.04 /* the largest b */

/* The distance between the peak and the trough of the edge detector, in degrees. */
#define EDGE_WIDTH 0.082

/* Weights below this part of the middle one are dropped: they are close to the rounding of a float. Luminance and
 * red-green have 11 taps instead of 21. */
#define NEGLIGIBLE 1e-6

static int round_up(double x)
{
    return (int)-floor(-x);
}

static void store_weights(flip_kernel *kernel, const double *weights, int radius, double scale)
{
    *kernel = (flip_kernel){.radius = radius};
    while (kernel->radius > 0 && fabs(weights[kernel->radius]) < NEGLIGIBLE * fabs(weights[0]))
        kernel->radius--;
    for (int k = 0; k <= kernel->radius; k++)
        kernel->weights[k] = (float)(scale * weights[k]);
}

/* Compute the weights of a Gaussian. Returns the sum of the weights from -radius to radius. */
static double compute_gaussian(double factor, double exponent, int radius, double *weights)
{
    double sum = 0;
    for (int k = radius; k >= 0; k--) {
        const double power = exponent * k * k;
        weights[k] = power < -600 ? 0 : factor * portable_exp(power);
        sum += k > 0 ? 2 * weights[k] : weights[k];
    }
    return sum;
}

/* Compute the kernels whose products add up to a filter of the sum 1. */
static void make_blur(const sensitivity *of, int count, int radius, double pixels_per_degree, flip_kernel *kernels)
{
    double weights[2][FLIP_MOST_RADIUS + 1], square = 0;
    for (int i = 0; i < count; i++) {
        const double exponent = -PI * PI / (of[i].b * pixels_per_degree * pixels_per_degree);
        const double sum = compute_gaussian(sqrt(of[i].a * sqrt(PI / of[i].b)), exponent, radius, weights[i]);
        square += sum * sum;
    }
    for (int i = 0; i < count; i++)
        store_weights(&kernels[i], weights[i], radius, 1 / sqrt(square));
}

/* Scale the weights at 0..radius of an even or odd kernel so that the positive ones add up to 1, and the negative ones
 * to -1. */
static void balance(double *weights, int radius, bool odd)
{
    double positive = 0, negative = 0;
    for (int k = radius; k >= 0; k--) {
        const double both = k > 0 && !odd ? 2 * weights[k] : weights[k];
        positive += both > 0 ? both : 0;
        negative -= both < 0 ? both : 0;
    }
    for (int k = 0; k <= radius; k++)
        weights[k] /= weights[k] > 0 ? positive : negative > 0 ? negative : 1;
}

static void make_detectors(double pixels_per_degree, flip_kernels *kernels)
{
    const double deviation = 0.5 * EDGE_WIDTH * pixels_per_degree;
    const int radius = round_up(3 * deviation);
    double smooth[FLIP_MOST_RADIUS + 1], edge[FLIP_MOST_RADIUS + 1], point[FLIP_MOST_RADIUS + 1];
    const double sum = compute_gaussian(1, -0.5 / (deviation * deviation), radius, smooth);
    for (int k = 0; k <= radius; k++) {
        edge[k] = k * smooth[k];
        point[k] = (k * k / (deviation * deviation) - 1) * smooth[k];
    }
    balance(edge, radius, true);
    balance(point, radius, false);
    store_weights(&kernels->smooth, smooth, radius, 1 / sum);
    store_weights(&kernels->edge, edge, radius, 1);
    store_weights(&kernels->point, point, radius, 1);
}

flip_kernels flip_make_kernels(double pixels_per_degree)
{
    const int radius = round_up(3 * sqrt(WIDEST / (2 * PI * PI)) * pixels_per_degree);
    flip_kernels made = {.reach = (radius + FLIP_STEP - 1) / FLIP_STEP * FLIP_STEP};
    make_blur(&LUMINANCE, 1, radius, pixels_per_degree, &made.luminance);
    make_blur(&RED_GREEN, 1, radius, pixels_per_degree, &made.red_green);
    make_blur(BLUE_YELLOW, 2, radius, pixels_per_degree, made.blue_yellow);
    make_detectors(pixels_per_degree, &made);
    return made;
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* Returns the sum of FLIP_STEP pairs of taps of an even kernel at pixel x. up[0] is the row that w[0] weighs, up[1] the
 * row below it; down[0] is the other row of w[0], down[-1] the row above it. */
static inline float sum_even(const float *w, const float *const *up, const float *const *down, int x)
{
    return w[0] * (up[0][x] + down[0][x]) + w[1] * (up[1][x] + down[-1][x]) + w[2] * (up[2][x] + down[-2][x]) +
           w[3] * (up[3][x] + down[-3][x]) + w[4] * (up[4][x] + down[-4][x]);
}

static inline float sum_odd(const float *w, const float *const *up, const float *const *down, int x)
{
    return w[0] * (up[0][x] - down[0][x]) + w[1] * (up[1][x] - down[-1][x]) + w[2] * (up[2][x] - down[-2][x]) +
           w[3] * (up[3][x] - down[-3][x]) + w[4] * (up[4][x] - down[-4][x]);
}

/* Add FLIP_STEP pairs. The pointers are copied, because gcc 12 does not vectorize a loop that loads them. */
static void add_pairs(const float *w, const float *const *up, const float *const *down, int count, float *restrict out)
{
    const float *const rows[] = {up[0], up[1], up[2], up[3], up[4]};
    const float *const others[] = {down[-4], down[-3], down[-2], down[-1], down[0]};
    const float weights[] = {w[0], w[1], w[2], w[3], w[4]};
    for (int x = 0; x < count; x++)
        out[x] += sum_even(weights, rows, others + 4, x);
}

/* Add all pairs but the first FLIP_STEP. */
static void add_far_pairs(const flip_kernel *even, const float *const *middle, int count, float *restrict out)
{
    for (int k = 1 + FLIP_STEP; k <= even->radius; k += FLIP_STEP)
        add_pairs(even->weights + k, middle + k, middle - k, count, out);
}

void filter_even(const flip_kernel *even, const float *const *middle, int count, float *restrict out)
{
    const float *w = even->weights;
    for (int x = 0; x < count; x++)
        out[x] = w[0] * middle[0][x] + sum_even(w + 1, middle + 1, middle - 1, x);
    add_far_pairs(even, middle, count, out);
}

void filter_even_add(const flip_kernel *even, const float *const *middle, int count, float *restrict out)
{
    const float *w = even->weights;
    for (int x = 0; x < count; x++)
        out[x] += w[0] * middle[0][x] + sum_even(w + 1, middle + 1, middle - 1, x);
    add_far_pairs(even, middle, count, out);
}

void filter_two_even(const flip_kernel *large, const flip_kernel *small, const float *const *middle, int count,
                     float *restrict out_large, float *restrict out_small)
{
    const float *v = large->weights, *w = small->weights;
    for (int x = 0; x < count; x++) {
        out_large[x] = v[0] * middle[0][x] + sum_even(v + 1, middle + 1, middle - 1, x);
        out_small[x] = w[0] * middle[0][x] + sum_even(w + 1, middle + 1, middle - 1, x);
    }
    for (int k = 1 + FLIP_STEP; k <= large->radius; k += FLIP_STEP)
        for (int x = 0; x < count; x++) {
            out_large[x] += sum_even(v + k, middle + k, middle - k, x);
            out_small[x] += sum_even(w + k, middle + k, middle - k, x);
        }
}

void filter_even_and_odd(const flip_kernel *even, const flip_kernel *odd, const float *const *middle, int count,
                         float *restrict out, float *restrict out_odd)
{
    const float *v = even->weights, *w = odd->weights;
    for (int x = 0; x < count; x++) {
        out[x] = v[0] * middle[0][x] + sum_even(v + 1, middle + 1, middle - 1, x);
        out_odd[x] = sum_odd(w + 1, middle + 1, middle - 1, x);
    }
    for (int k = 1 + FLIP_STEP; k <= even->radius || k <= odd->radius; k += FLIP_STEP)
        for (int x = 0; x < count; x++) {
            out[x] += sum_even(v + k, middle + k, middle - k, x);
            out_odd[x] += sum_odd(w + k, middle + k, middle - k, x);
        }
}
