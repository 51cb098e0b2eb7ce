/* compare.c - the difference of two images: counting and judging. */
#include "antialias.h"
#include "samples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Two images while they are compared. */
typedef struct comparison {
    const image *a, *b;
    const image_tolerance *tolerance;
    image_difference *difference; /* its worst_delta are squares, until all is counted */
    pixel_samples last[2];        /* the unlike colours that were measured last: neighbours often differ alike */
    double last_square;
    int last_channel;
} comparison;

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* Do equal bytes mean equal colours? The whole tables count: they are always there. */
static bool stored_alike(const image *a, const image *b)
{
    if (a->channels != b->channels || a->wide != b->wide)
        return false;
    return a->channels == 3 || memcmp(a->palette.colors, b->palette.colors, sizeof a->palette.colors) == 0;
}

/* ---- Counting ------------------------------------------------------------------------------------------------ */

static void measure(comparison *c, const pixel_samples *a, const pixel_samples *b)
{
    if (samples_equal(a, &c->last[0]) && samples_equal(b, &c->last[1]))
        return;
    c->last[0] = *a;
    c->last[1] = *b;
    c->last_square = delta_square(a, b, c->difference->channel_range);
    c->last_channel = 0;
    for (int i = 0; i < 3; i++)
        c->last_channel = larger(c->last_channel, abs(a->of[i] - b->of[i]));
}

static void add_pixel(image_tally *tally, int x, int y, const comparison *c)
{
    if (tally->pixels++ == 0) {
        tally->min_x = x;
        tally->min_y = y;
    }
    if (c->last_square > tally->worst_delta) {
        tally->worst_delta = c->last_square;
        tally->worst_x = x;
        tally->worst_y = y;
    }
    tally->largest_channel = larger(tally->largest_channel, c->last_channel);
    tally->min_x = smaller(tally->min_x, x);
    tally->max_x = larger(tally->max_x, x);
    tally->max_y = y; /* rows come in order */
}

static void count_pixel(comparison *c, int x, int y, const pixel_samples *a, const pixel_samples *b)
{
    const image_tolerance *tolerance = c->tolerance;
    image_difference *difference = c->difference;
    if (tolerance_ignores(tolerance, x, y)) {
        difference->ignored++;
        return;
    }
    measure(c, a, b);
    add_pixel(&difference->unlike, x, y, c);
    if (c->last_square <= tolerance->max_delta * tolerance->max_delta)
        difference->close++;
    else if (tolerance->antialias && antialias_explains(c->a, c->b, x, y))
        difference->antialiased++;
    else
        add_pixel(&difference->counted, x, y, c);
}

static void count_row(comparison *c, int y, bool alike)
{
    pixel_samples span_a[SPAN], span_b[SPAN];
    const size_t step = image_pixel_size(c->a);
    for (int x = 0; x < c->a->width; x += SPAN) {
        const int count = smaller(SPAN, c->a->width - x);
        const size_t n = (size_t)y * (size_t)c->a->width + (size_t)x;
        if (alike && memcmp(c->a->pixels + n * step, c->b->pixels + n * step, (size_t)count * step) == 0)
            continue;
        samples_read(c->a, n, count, c->difference->channel_range, span_a);
        samples_read(c->b, n, count, c->difference->channel_range, span_b);
        for (int i = 0; i < count; i++)
            if (!samples_equal(&span_a[i], &span_b[i]))
                count_pixel(c, x + i, y, &span_a[i], &span_b[i]);
    }
}

image_difference image_compare_within(const image *a, const image *b, const image_tolerance *tolerance)
{
    static const image_tally none = {.worst_x = -1, .worst_y = -1, .min_x = -1, .min_y = -1, .max_x = -1, .max_y = -1};
    image_difference difference = {
        .same_size = a->width == b->width && a->height == b->height,
        .channel_range = samples_range(a, b),
        .unlike = none,
        .counted = none,
    };
    comparison c = {.a = a, .b = b, .tolerance = tolerance, .difference = &difference};
    const bool alike = stored_alike(a, b);
    for (int y = 0; difference.same_size && y < a->height; y++)
        count_row(&c, y, alike);
    difference.unlike.worst_delta = sqrt(difference.unlike.worst_delta);
    difference.counted.worst_delta = sqrt(difference.counted.worst_delta);
    return difference;
}

image_difference image_compare(const image *a, const image *b)
{
    static const image_tolerance exact = {.max_pixels = 0};
    return image_compare_within(a, b, &exact);
}

/* ---- Judging ------------------------------------------------------------------------------------------------- */

bool image_same(const image_difference *difference)
{
    return difference->same_size && difference->unlike.pixels == 0 && difference->ignored == 0;
}

bool image_forgiven(const image_difference *difference, const image_tolerance *tolerance)
{
    return difference->same_size && difference->counted.pixels <= tolerance->max_pixels;
}
