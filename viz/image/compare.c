/* compare.c - the difference of two images: counting, judging, drawing. */
#include "antialias.h"
#include "delta.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Colours are compared in spans of this many pixels, small enough for the stack and the first cache. */
#define SPAN 128

static const image_color UNLIKE_COLOR = {255, 0, 0};

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

/* Samples of `count` pixels, as wide as the wider of both images has them. */
static void read_span(const image *image, size_t n, int count, int range, pixel_samples span[SPAN])
{
    const size_t step = image_pixel_size(image);
    const unsigned scale = range == 65535 ? 257 : 1;
    const uint8_t *at = image->pixels + n * step;
    if (image->wide) {
        memcpy(span, at, (size_t)count * sizeof *span);
        return;
    }
    for (int i = 0; i < count; i++, at += step) {
        const image_color color =
            image->channels == 1 ? image->palette.colors[*at] : (image_color){at[0], at[1], at[2]};
        span[i] =
            (pixel_samples){{(uint16_t)(color.r * scale), (uint16_t)(color.g * scale), (uint16_t)(color.b * scale)}};
    }
}

static bool equal_samples(const pixel_samples *a, const pixel_samples *b)
{
    return a->of[0] == b->of[0] && a->of[1] == b->of[1] && a->of[2] == b->of[2];
}

static void measure(comparison *c, const pixel_samples *a, const pixel_samples *b)
{
    if (equal_samples(a, &c->last[0]) && equal_samples(b, &c->last[1]))
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

static bool is_ignored(const image_tolerance *tolerance, int x, int y)
{
    for (size_t i = 0; i < tolerance->ignored_count; i++) {
        const image_rectangle *r = &tolerance->ignored[i];
        if (x >= r->x && y >= r->y && x - r->x < r->width && y - r->y < r->height)
            return true;
    }
    return false;
}

static void count_pixel(comparison *c, int x, int y, const pixel_samples *a, const pixel_samples *b)
{
    const image_tolerance *tolerance = c->tolerance;
    image_difference *difference = c->difference;
    if (is_ignored(tolerance, x, y)) {
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
        read_span(c->a, n, count, c->difference->channel_range, span_a);
        read_span(c->b, n, count, c->difference->channel_range, span_b);
        for (int i = 0; i < count; i++)
            if (!equal_samples(&span_a[i], &span_b[i]))
                count_pixel(c, x + i, y, &span_a[i], &span_b[i]);
    }
}

image_difference image_compare_within(const image *a, const image *b, const image_tolerance *tolerance)
{
    static const image_tally none = {.worst_x = -1, .worst_y = -1, .min_x = -1, .min_y = -1, .max_x = -1, .max_y = -1};
    image_difference difference = {
        .same_size = a->width == b->width && a->height == b->height,
        .channel_range = a->wide || b->wide ? 65535 : 255,
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

/* ---- Drawing ------------------------------------------------------------------------------------------------- */

/* A light grey, so that nothing but a difference is coloured. */
static image_color faint(image_color color)
{
    int grey = (77 * color.r + 150 * color.g + 29 * color.b) / 256;
    uint8_t light = (uint8_t)(255 - (255 - grey) / 4);
    return (image_color){light, light, light};
}

bool image_draw_difference(const image *a, const image *b, image *out)
{
    if (!image_create(out, smaller(a->width, b->width), smaller(a->height, b->height), 3))
        return false;
    uint8_t *at = out->pixels;
    for (int y = 0; y < out->height; y++) {
        for (int x = 0; x < out->width; x++, at += 3) {
            image_color color_a = image_color_at(a, x, y);
            image_color color_b = image_color_at(b, x, y);
            bool unlike = memcmp(&color_a, &color_b, sizeof color_a) != 0;
            image_color drawn = unlike ? UNLIKE_COLOR : faint(color_a);
            memcpy(at, &drawn, 3);
        }
    }
    return true;
}
