/* SPDX-License-Identifier: MIT */
/* flip_filter.c - computes the kernels of FLIP and applies them to rows.
 *
 * A picture of N pixels and a filter of K x K weights cost N K K products. All filters of FLIP are Gaussians, their
 * derivatives, or a sum of two Gaussians. Such a filter is a product of a function of x and a function of y, so that a
 * pass along the rows and a pass along the columns cost 2 N K. The kernels are also even or odd, so that two taps share
 * a product. Both passes use the same functions: a tap is a pointer to a row, and in the pass along the rows it points
 * k floats further into the same row.
 *
 * Each sum is computed tap by tap for all pixels of a row. A compiler may then compute several pixels at once without
 * changing the order of any sum, which would change bits. Five pairs of taps are added at a time, so that the sum is
 * loaded and stored less often.
 *
 * Source of the kernels: P. Andersson and others, "FLIP: A Difference Evaluator for Alternating Images", 2020, sections
 * 4.1.1 and 4.2.1. The authors also describe the split of the sum of two Gaussians. */
#include "flip_filter.h"
#include "portable_math.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

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
    const int radius = (int)ceil(3 * deviation);
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
    const int radius = (int)ceil(3 * sqrt(WIDEST / (2 * PI * PI)) * pixels_per_degree);
    flip_kernels made = {.reach = (radius + FLIP_STEP - 1) / FLIP_STEP * FLIP_STEP};
    make_blur(&LUMINANCE, 1, radius, pixels_per_degree, &made.luminance);
    make_blur(&RED_GREEN, 1, radius, pixels_per_degree, &made.red_green);
    make_blur(BLUE_YELLOW, 2, radius, pixels_per_degree, made.blue_yellow);
    make_detectors(pixels_per_degree, &made);
    return made;
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* Add the FLIP_STEP pairs of taps from k on of an even kernel. w points to the weight of k, up to the row k below the
 * middle row, and down to the row k above it. */
static void add_pairs(const float *w, const float *const *up, const float *const *down, int count, float *restrict out)
{
    const float *a = up[0], *b = up[1], *c = up[2], *d = up[3], *e = up[4];
    const float *p = down[0], *q = down[-1], *r = down[-2], *s = down[-3], *t = down[-4];
    for (int x = 0; x < count; x++)
        out[x] += w[0] * (a[x] + p[x]) + w[1] * (b[x] + q[x]) + w[2] * (c[x] + r[x]) + w[3] * (d[x] + s[x]) +
                  w[4] * (e[x] + t[x]);
}

/* As add_pairs(), for two kernels. */
static void add_pairs_twice(const float *w, const float *v, const float *const *up, const float *const *down, int count,
                            float *restrict out, float *restrict other)
{
    const float *a = up[0], *b = up[1], *c = up[2], *d = up[3], *e = up[4];
    const float *p = down[0], *q = down[-1], *r = down[-2], *s = down[-3], *t = down[-4];
    for (int x = 0; x < count; x++) {
        const float ap = a[x] + p[x], bq = b[x] + q[x], cr = c[x] + r[x], ds = d[x] + s[x], et = e[x] + t[x];
        out[x] += w[0] * ap + w[1] * bq + w[2] * cr + w[3] * ds + w[4] * et;
        other[x] += v[0] * ap + v[1] * bq + v[2] * cr + v[3] * ds + v[4] * et;
    }
}

/* As add_pairs(), for an even kernel and an odd one. */
static void add_pairs_and_odd(const float *w, const float *v, const float *const *up, const float *const *down,
                              int count, float *restrict out, float *restrict odd)
{
    const float *a = up[0], *b = up[1], *c = up[2], *d = up[3], *e = up[4];
    const float *p = down[0], *q = down[-1], *r = down[-2], *s = down[-3], *t = down[-4];
    for (int x = 0; x < count; x++) {
        out[x] += w[0] * (a[x] + p[x]) + w[1] * (b[x] + q[x]) + w[2] * (c[x] + r[x]) + w[3] * (d[x] + s[x]) +
                  w[4] * (e[x] + t[x]);
        odd[x] += v[0] * (a[x] - p[x]) + v[1] * (b[x] - q[x]) + v[2] * (c[x] - r[x]) + v[3] * (d[x] - s[x]) +
                  v[4] * (e[x] - t[x]);
    }
}

static void multiply(float weight, const float *row, int count, float *restrict out)
{
    for (int x = 0; x < count; x++)
        out[x] = weight * row[x];
}

static void add_all_pairs(const flip_kernel *even, const float *const *middle, int count, float *restrict out)
{
    for (int k = 1; k <= even->radius; k += FLIP_STEP)
        add_pairs(even->weights + k, middle + k, middle - k, count, out);
}

void filter_even(const flip_kernel *even, const float *const *middle, int count, float *restrict out)
{
    multiply(even->weights[0], middle[0], count, out);
    add_all_pairs(even, middle, count, out);
}

void filter_even_add(const flip_kernel *even, const float *const *middle, int count, float *restrict out)
{
    for (int x = 0; x < count; x++)
        out[x] += even->weights[0] * middle[0][x];
    add_all_pairs(even, middle, count, out);
}

void filter_two_even(const flip_kernel *large, const flip_kernel *small, const float *const *middle, int count,
                     float *restrict out_large, float *restrict out_small)
{
    multiply(large->weights[0], middle[0], count, out_large);
    multiply(small->weights[0], middle[0], count, out_small);
    for (int k = 1; k <= large->radius; k += FLIP_STEP)
        add_pairs_twice(large->weights + k, small->weights + k, middle + k, middle - k, count, out_large, out_small);
}

void filter_even_and_odd(const flip_kernel *even, const flip_kernel *odd, const float *const *middle, int count,
                         float *restrict out, float *restrict out_odd)
{
    multiply(even->weights[0], middle[0], count, out);
    memset(out_odd, 0, (size_t)count * sizeof *out_odd);
    for (int k = 1; k <= even->radius || k <= odd->radius; k += FLIP_STEP)
        add_pairs_and_odd(even->weights + k, odd->weights + k, middle + k, middle - k, count, out, out_odd);
}
