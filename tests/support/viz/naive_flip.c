/* SPDX-License-Identifier: MIT */
/* naive_flip.c - see naive_flip.h. Nothing is shared with the code under test: the filters are not split into passes,
 * and colours go through sRGB, XYZ, YCxCz, XYZ, RGB, XYZ and Lab one step after the other. */
#include "naive_flip.h"
#include "fixture.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

/* Numbers of a pixel: a colour in some space. */
typedef struct triple {
    double of[3];
} triple;

/* ---- Colours ----------------------------------------------------------------------------------------------------- */

static triple multiply(const double m[3][3], triple t)
{
    triple product;
    for (int i = 0; i < 3; i++)
        product.of[i] = m[i][0] * t.of[0] + m[i][1] * t.of[1] + m[i][2] * t.of[2];
    return product;
}

/* IEC 61966-2-1, as fractions; X, Y and Z of white are the sums of the rows. */
static const double to_xyz[3][3] = {
    {10135552 / 24577794.0, 8788810 / 24577794.0, 4435075 / 24577794.0},
    {2613072 / 12288897.0, 8788810 / 12288897.0, 887015 / 12288897.0},
    {1425312 / 73733382.0, 8788810 / 73733382.0, 70074185 / 73733382.0},
};

static double white(int i)
{
    return to_xyz[i][0] + to_xyz[i][1] + to_xyz[i][2];
}

/* Cramer's rule. */
static triple xyz_to_rgb(triple xyz)
{
    triple rgb;
    double determinant = 0;
    for (int i = 0; i < 3; i++)
        determinant += to_xyz[0][i] * (to_xyz[1][(i + 1) % 3] * to_xyz[2][(i + 2) % 3] -
                                       to_xyz[1][(i + 2) % 3] * to_xyz[2][(i + 1) % 3]);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        rgb.of[i] = (xyz.of[0] * (to_xyz[1][j] * to_xyz[2][k] - to_xyz[1][k] * to_xyz[2][j]) +
                     xyz.of[1] * (to_xyz[2][j] * to_xyz[0][k] - to_xyz[2][k] * to_xyz[0][j]) +
                     xyz.of[2] * (to_xyz[0][j] * to_xyz[1][k] - to_xyz[0][k] * to_xyz[1][j])) /
                    determinant;
    }
    return rgb;
}

static triple ycxcz_of(image_color c)
{
    const double samples[3] = {c.r / 255.0, c.g / 255.0, c.b / 255.0};
    triple rgb;
    for (int i = 0; i < 3; i++)
        rgb.of[i] = samples[i] <= 0.04045 ? samples[i] / 12.92 : pow((samples[i] + 0.055) / 1.055, 2.4);
    const triple xyz = multiply(to_xyz, rgb);
    const double x = xyz.of[0] / white(0), y = xyz.of[1] / white(1), z = xyz.of[2] / white(2);
    return (triple){{116 * y - 16, 500 * (x - y), 200 * (y - z)}};
}

static triple ycxcz_to_rgb(triple t)
{
    const double y = (t.of[0] + 16) / 116;
    triple rgb = xyz_to_rgb((triple){{(y + t.of[1] / 500) * white(0), y * white(1), (y - t.of[2] / 200) * white(2)}});
    for (int i = 0; i < 3; i++)
        rgb.of[i] = fmin(1, fmax(0, rgb.of[i]));
    return rgb;
}

/* CIELAB, adjusted as Hunt has it. */
static triple lab_of(triple rgb)
{
    const triple xyz = multiply(to_xyz, rgb);
    double f[3];
    for (int i = 0; i < 3; i++) {
        const double part = xyz.of[i] / white(i), d = 6 / 29.0;
        f[i] = part > d * d * d ? cbrt(part) : part / (3 * d * d) + 4 / 29.0;
    }
    const double l = 116 * f[1] - 16;
    return (triple){{l, 0.01 * l * 500 * (f[0] - f[1]), 0.01 * l * 200 * (f[1] - f[2])}};
}

static double hyab(triple a, triple b)
{
    return fabs(a.of[0] - b.of[0]) + hypot(a.of[1] - b.of[1], a.of[2] - b.of[2]);
}

double naive_flip_largest_difference(void)
{
    return pow(hyab(lab_of((triple){{0, 1, 0}}), lab_of((triple){{0, 0, 1}})), 0.7);
}

/* ---- Filters ----------------------------------------------------------------------------------------------------- */

/* The weight at (x, y), in pixels, before it is normalized. */
typedef double weight(double x, double y, double pixels_per_degree);

static double sensitivity(double a, double b, double x, double y, double pixels_per_degree)
{
    const double square = (x * x + y * y) / (pixels_per_degree * pixels_per_degree);
    return a * sqrt(pi / b) * exp(-pi * pi * square / b);
}

static double luminance_weight(double x, double y, double pixels_per_degree)
{
    return sensitivity(1, 0.0047, x, y, pixels_per_degree);
}

static double red_green_weight(double x, double y, double pixels_per_degree)
{
    return sensitivity(1, 0.0053, x, y, pixels_per_degree);
}

static double blue_yellow_weight(double x, double y, double pixels_per_degree)
{
    return sensitivity(34.1, 0.04, x, y, pixels_per_degree) + sensitivity(13.5, 0.025, x, y, pixels_per_degree);
}

static double detector_deviation(double pixels_per_degree)
{
    return 0.5 * 0.082 * pixels_per_degree;
}

static double edge_weight(double x, double y, double pixels_per_degree)
{
    const double s = detector_deviation(pixels_per_degree);
    return -x * exp(-(x * x + y * y) / (2 * s * s));
}

static double point_weight(double x, double y, double pixels_per_degree)
{
    const double s = detector_deviation(pixels_per_degree);
    return (x * x / (s * s) - 1) * exp(-(x * x + y * y) / (2 * s * s));
}

static double edge_weight_y(double x, double y, double pixels_per_degree)
{
    return edge_weight(y, x, pixels_per_degree);
}

static double point_weight_y(double x, double y, double pixels_per_degree)
{
    return point_weight(y, x, pixels_per_degree);
}

/* A filter of (2 radius + 1)^2 weights, of which the positive ones add up to 1 and the negative ones to -1. */
typedef struct filter {
    int radius;
    double *weights;
} filter;

static filter make_filter(weight *of, int radius, double pixels_per_degree)
{
    const int side = 2 * radius + 1;
    filter made = {radius, malloc((size_t)(side * side) * sizeof *made.weights)};
    double positive = 0, negative = 0;
    assert_non_null(made.weights);
    for (int i = 0; i < side * side; i++) {
        made.weights[i] = of(i % side - radius, i / side - radius, pixels_per_degree);
        positive += fmax(0, made.weights[i]);
        negative += fmax(0, -made.weights[i]);
    }
    for (int i = 0; i < side * side; i++)
        made.weights[i] /= made.weights[i] > 0 ? positive : negative > 0 ? negative : 1;
    return made;
}

static int nearest(int at, int length)
{
    return at < 0 ? 0 : at < length ? at : length - 1;
}

/* Filter one number of the pixel (x, y). Pixels beyond the border have the colour of the nearest pixel. */
static double apply(const filter *f, const triple *pixels, int width, int height, int x, int y, int which)
{
    double sum = 0;
    const double *w = f->weights;
    for (int j = -f->radius; j <= f->radius; j++)
        for (int i = -f->radius; i <= f->radius; i++)
            sum += *w++ * pixels[nearest(y + j, height) * width + nearest(x + i, width)].of[which];
    return sum;
}

/* ---- The image --------------------------------------------------------------------------------------------------- */

enum { LUMINANCE, RED_GREEN, BLUE_YELLOW, EDGE_X, EDGE_Y, POINT_X, POINT_Y, FILTERS };

/* What the filters make of an image: a colour, and the strengths of edges and points. */
typedef struct impression {
    triple color;
    double edge, point;
} impression;

static triple *convert(const image *of)
{
    triple *pixels = malloc((size_t)of->width * (size_t)of->height * sizeof *pixels);
    assert_non_null(pixels);
    for (int i = 0; i < of->width * of->height; i++)
        pixels[i] = ycxcz_of(image_color_at(of, i % of->width, i / of->width));
    return pixels;
}

static impression look(const filter *filters, const triple *pixels, int width, int height, int x, int y)
{
    triple blurred;
    double features[FILTERS];
    for (int i = 0; i < 3; i++)
        blurred.of[i] = apply(&filters[i], pixels, width, height, x, y, i);
    for (int i = EDGE_X; i < FILTERS; i++) /* the detectors see luminance from 0 to 1, and their weights add up to 0 */
        features[i] = apply(&filters[i], pixels, width, height, x, y, 0) / 116;
    return (impression){lab_of(ycxcz_to_rgb(blurred)), hypot(features[EDGE_X], features[EDGE_Y]),
                        hypot(features[POINT_X], features[POINT_Y])};
}

static double value_of(const impression *a, const impression *b)
{
    const double most = naive_flip_largest_difference(), bend = 0.4 * most;
    const double difference = pow(hyab(a->color, b->color), 0.7);
    const double color =
        difference < bend ? 0.95 / bend * difference : 0.95 + (difference - bend) / (most - bend) * (1 - 0.95);
    const double feature = fmax(fabs(a->edge - b->edge), fabs(a->point - b->point));
    return pow(color, 1 - sqrt(feature / sqrt(2)));
}

double *naive_flip(const image *a, const image *b, double pixels_per_degree)
{
    static weight *const weights[FILTERS] = {luminance_weight, red_green_weight, blue_yellow_weight, edge_weight,
                                             edge_weight_y,    point_weight,     point_weight_y};
    const int blur = (int)ceil(3 * sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree);
    const int detector = (int)ceil(3 * detector_deviation(pixels_per_degree));
    filter filters[FILTERS];
    double *values = malloc((size_t)a->width * (size_t)a->height * sizeof *values);
    triple *pixels[2] = {convert(a), convert(b)};
    assert_non_null(values);
    for (int i = 0; i < FILTERS; i++)
        filters[i] = make_filter(weights[i], i < EDGE_X ? blur : detector, pixels_per_degree);
    for (int i = 0; i < a->width * a->height; i++) {
        const impression p = look(filters, pixels[0], a->width, a->height, i % a->width, i / a->width),
                         q = look(filters, pixels[1], a->width, a->height, i % a->width, i / a->width);
        values[i] = value_of(&p, &q);
    }
    for (int i = 0; i < FILTERS; i++)
        free(filters[i].weights);
    free(pixels[0]);
    free(pixels[1]);
    return values;
}
