/* compare.c - the difference of two images: counting and judging. */
#include "antialias.h"
#include "image_compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The next rows of both images. */
typedef struct rows {
    const image *a, *b;
    int first; /* their place in the whole */
} rows;

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

static void measure(image_comparison *c, const pixel_samples *a, const pixel_samples *b)
{
    if (memcmp(a, c->last[0], sizeof *a) == 0 && memcmp(b, c->last[1], sizeof *b) == 0)
        return;
    memcpy(c->last[0], a, sizeof *a);
    memcpy(c->last[1], b, sizeof *b);
    c->last_square = delta_square(a, b, c->difference.channel_range);
    c->last_channel = 0;
    for (int i = 0; i < 3; i++)
        c->last_channel = larger(c->last_channel, abs(a->of[i] - b->of[i]));
}

static void add_pixel(image_tally *tally, int x, int y, const image_comparison *c)
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

static void count_pixel(image_comparison *c, const rows *r, int x, int y, const pixel_samples *a,
                        const pixel_samples *b)
{
    const image_tolerance *tolerance = c->tolerance;
    image_difference *difference = &c->difference;
    if (image_is_ignored(tolerance, r->a->width, x, r->first + y)) {
        difference->ignored++;
        return;
    }
    measure(c, a, b);
    add_pixel(&difference->unlike, x, r->first + y, c);
    if (c->last_square <= tolerance->max_delta * tolerance->max_delta)
        difference->close++;
    else if (tolerance->antialias && antialias_explains(r->a, r->b, x, y))
        difference->antialiased++;
    else
        add_pixel(&difference->counted, x, r->first + y, c);
}

/* How many pixels are stored alike before the first that is not. */
static int run_alike(const uint8_t *a, const uint8_t *b, int count, size_t step)
{
    const size_t size = (size_t)count * step;
    size_t at = 0;
    while (at + 8 <= size && memcmp(a + at, b + at, 8) == 0)
        at += 8;
    while (at < size && a[at] == b[at])
        at++;
    return (int)(at / step);
}

/* Of `count` pixels from (x, y) on, stored so that equal bytes mean equal colours. */
static void count_alike(image_comparison *c, const rows *r, int x, int y, int count)
{
    const size_t step = image_pixel_size(r->a), n = (size_t)y * (size_t)r->a->width + (size_t)x;
    const uint8_t *a = r->a->pixels + n * step, *b = r->b->pixels + n * step;
    if (memcmp(a, b, (size_t)count * step) == 0)
        return;
    for (int i = 0; (i += run_alike(a + (size_t)i * step, b + (size_t)i * step, count - i, step)) < count; i++) {
        pixel_samples of_a, of_b;
        samples_read(r->a, n + (size_t)i, 1, c->difference.channel_range, &of_a);
        samples_read(r->b, n + (size_t)i, 1, c->difference.channel_range, &of_b);
        if (!samples_equal(&of_a, &of_b)) /* a palette may have a colour twice */
            count_pixel(c, r, x + i, y, &of_a, &of_b);
    }
}

static void count_colors(image_comparison *c, const rows *r, int x, int y, int count)
{
    const size_t n = (size_t)y * (size_t)r->a->width + (size_t)x;
    pixel_samples span_a[SPAN], span_b[SPAN];
    samples_read(r->a, n, count, c->difference.channel_range, span_a);
    samples_read(r->b, n, count, c->difference.channel_range, span_b);
    for (int i = 0; i < count; i++)
        if (!samples_equal(&span_a[i], &span_b[i]))
            count_pixel(c, r, x + i, y, &span_a[i], &span_b[i]);
}

image_comparison image_comparison_begin(const image *a, const image *b, const image_tolerance *tolerance)
{
    static const image_tally none = {.worst_x = -1, .worst_y = -1, .min_x = -1, .min_y = -1, .max_x = -1, .max_y = -1};
    return (image_comparison){
        .tolerance = tolerance,
        .difference = {.same_size = a->width == b->width && a->height == b->height,
                       .channel_range = samples_range(a, b),
                       .unlike = none,
                       .counted = none},
        .stored_alike = stored_alike(a, b),
    };
}

void image_comparison_add(image_comparison *c, const image *a, const image *b)
{
    const rows r = {a, b, c->y};
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x += SPAN)
            (c->stored_alike ? count_alike : count_colors)(c, &r, x, y, smaller(SPAN, a->width - x));
    c->y += a->height;
}

image_difference image_comparison_end(const image_comparison *c)
{
    image_difference difference = c->difference;
    difference.unlike.worst_delta = sqrt(difference.unlike.worst_delta);
    difference.counted.worst_delta = sqrt(difference.counted.worst_delta);
    return difference;
}

image_difference image_compare_within(const image *a, const image *b, const image_tolerance *tolerance)
{
    image_comparison c = image_comparison_begin(a, b, tolerance);
    if (c.difference.same_size)
        image_comparison_add(&c, a, b);
    return image_comparison_end(&c);
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
