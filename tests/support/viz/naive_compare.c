/* SPDX-License-Identifier: MIT */
/* naive_compare.c - see naive_compare.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "naive_compare.h"

#include <math.h>
#include <string.h>

/* ---- Colours ------------------------------------------------------------------------------------------------ */

void naive_color(const image *image, int x, int y, double rgb[3])
{
    const long n = (long)y * image->width + x;
    for (int i = 0; i < 3; i++) {
        if (image->channels == 1) {
            const image_color color = image->palette.colors[image->pixels[n]];
            rgb[i] = (i == 0 ? color.r : i == 1 ? color.g : color.b) / 255.0;
        } else if (image->wide) {
            uint16_t sample;
            memcpy(&sample, image->pixels + 2 * (3 * n + i), 2);
            rgb[i] = sample / 65535.0;
        } else {
            rgb[i] = image->pixels[3 * n + i] / 255.0;
        }
    }
}

static void to_yiq(const double rgb[3], long double yiq[3])
{
    static const long double rows[3][3] = {
        {0.29889531L, 0.58662247L, 0.11448223L},
        {0.59597799L, -0.27417610L, -0.32180189L},
        {0.21147017L, -0.52261711L, 0.31114694L},
    };
    for (int i = 0; i < 3; i++)
        yiq[i] = 255 * (rows[i][0] * rgb[0] + rows[i][1] * rgb[1] + rows[i][2] * rgb[2]);
}

double naive_delta(const double a[3], const double b[3])
{
    long double from[3], to[3], sum = 0;
    static const long double weights[3] = {0.5053L, 0.299L, 0.1957L};
    to_yiq(a, from);
    to_yiq(b, to);
    for (int i = 0; i < 3; i++)
        sum += weights[i] * (from[i] - to[i]) * (from[i] - to[i]);
    return (double)sqrtl(sum / 35215.0L);
}

static bool equal(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* ---- Anti-aliasing ------------------------------------------------------------------------------------------ */

/* The colours that the method looks at have 8 bits a sample. */
static void coarse_color(const image *image, int x, int y, double rgb[3])
{
    naive_color(image, x, y, rgb);
    for (int i = 0; i < 3; i++)
        rgb[i] = floor(rgb[i] * 255 + 0.5);
}

/* Whole numbers up to 255e8: exact in a double. */
static double luma(const image *image, int x, int y)
{
    double rgb[3];
    coarse_color(image, x, y, rgb);
    return 29889531 * rgb[0] + 58662247 * rgb[1] + 11448223 * rgb[2];
}

static bool inside(const image *image, int x, int y)
{
    return x >= 0 && y >= 0 && x < image->width && y < image->height;
}

static bool at_border(const image *image, int x, int y)
{
    return x == 0 || y == 0 || x == image->width - 1 || y == image->height - 1;
}

static bool has_many_siblings(const image *image, int x, int y)
{
    double own[3], other[3];
    int siblings = at_border(image, x, y) ? 1 : 0;
    coarse_color(image, x, y, own);
    for (int i = x - 1; i <= x + 1; i++) {
        for (int j = y - 1; j <= y + 1; j++) {
            if ((i == x && j == y) || !inside(image, i, j))
                continue;
            coarse_color(image, i, j, other);
            siblings += equal(own, other);
        }
    }
    return siblings > 2;
}

static bool antialiased_in(const image *image, const struct image *other, int x, int y)
{
    int zeroes = at_border(image, x, y) ? 1 : 0, min_x = 0, min_y = 0, max_x = 0, max_y = 0;
    double min = 0, max = 0;
    for (int i = x - 1; i <= x + 1; i++) {
        for (int j = y - 1; j <= y + 1; j++) {
            if ((i == x && j == y) || !inside(image, i, j))
                continue;
            const double delta = luma(image, i, j) - luma(image, x, y);
            if (delta == 0) {
                zeroes++;
            } else if (delta < min) {
                min = delta;
                min_x = i;
                min_y = j;
            } else if (delta > max) {
                max = delta;
                max_x = i;
                max_y = j;
            }
        }
    }
    if (zeroes > 2 || min == 0 || max == 0)
        return false;
    return (has_many_siblings(image, min_x, min_y) && has_many_siblings(other, min_x, min_y)) ||
           (has_many_siblings(image, max_x, max_y) && has_many_siblings(other, max_x, max_y));
}

bool naive_antialiased(const image *a, const image *b, int x, int y)
{
    return antialiased_in(a, b, x, y) || antialiased_in(b, a, x, y);
}

/* ---- Counting ----------------------------------------------------------------------------------------------- */

static bool is_ignored(const image_tolerance *tolerance, int width, int x, int y)
{
    bool in = tolerance->ignored_mask && tolerance->ignored_mask[y * width + x];
    for (size_t i = 0; i < tolerance->ignored_count; i++) {
        const image_rectangle r = tolerance->ignored[i];
        in = in || (x >= r.x && x < (long)r.x + r.width && y >= r.y && y < (long)r.y + r.height);
    }
    return in;
}

static void tally(image_tally *t, int x, int y, double delta, int channel)
{
    const bool first = t->pixels == 0;
    t->pixels++;
    if (first || delta > t->worst_delta * (1 + 1e-12)) {
        t->worst_delta = delta;
        t->worst_x = x;
        t->worst_y = y;
    }
    t->largest_channel = first || channel > t->largest_channel ? channel : t->largest_channel;
    t->min_x = first || x < t->min_x ? x : t->min_x;
    t->max_x = first || x > t->max_x ? x : t->max_x;
    t->min_y = first || y < t->min_y ? y : t->min_y;
    t->max_y = first || y > t->max_y ? y : t->max_y;
}

static int channel_difference(const double a[3], const double b[3], int range)
{
    double most = 0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, fabs(a[i] - b[i]));
    return (int)floor(most * range + 0.5);
}

image_difference naive_compare(const image *a, const image *b, const image_tolerance *tolerance)
{
    const image_tally none = {0, 0, -1, -1, 0, -1, -1, -1, -1};
    image_difference d = {.same_size = a->width == b->width && a->height == b->height,
                          .channel_range = a->wide || b->wide ? 65535 : 255,
                          .unlike = none,
                          .counted = none};
    double from[3], to[3];
    for (int y = 0; d.same_size && y < a->height; y++) {
        for (int x = 0; x < a->width; x++) {
            naive_color(a, x, y, from);
            naive_color(b, x, y, to);
            if (equal(from, to))
                continue;
            if (is_ignored(tolerance, a->width, x, y)) {
                d.ignored++;
                continue;
            }
            const double delta = naive_delta(from, to);
            const int channel = channel_difference(from, to, d.channel_range);
            tally(&d.unlike, x, y, delta, channel);
            if (delta <= tolerance->max_delta || channel <= tolerance->max_channel)
                d.close++;
            else if (tolerance->antialias && naive_antialiased(a, b, x, y))
                d.antialiased++;
            else
                tally(&d.counted, x, y, delta, channel);
        }
    }
    return d;
}

static void assert_same_tally(const image_tally *a, const image_tally *b)
{
    assert_int_equal(a->pixels, b->pixels);
    assert_true(fabs(a->worst_delta - b->worst_delta) <= 1e-12);
    assert_int_equal(a->worst_x, b->worst_x);
    assert_int_equal(a->worst_y, b->worst_y);
    assert_int_equal(a->largest_channel, b->largest_channel);
    assert_true(a->min_x == b->min_x && a->max_x == b->max_x && a->min_y == b->min_y && a->max_y == b->max_y);
}

void assert_same_difference(const image_difference *a, const image_difference *b)
{
    assert_int_equal(a->same_size, b->same_size);
    assert_int_equal(a->channel_range, b->channel_range);
    assert_int_equal(a->close, b->close);
    assert_int_equal(a->antialiased, b->antialiased);
    assert_int_equal(a->ignored, b->ignored);
    assert_same_tally(&a->unlike, &b->unlike);
    assert_same_tally(&a->counted, &b->counted);
}
