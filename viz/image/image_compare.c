/* SPDX-License-Identifier: MIT */
/* image_compare.c - counts differing pixels, decides which of them are forgiven, and draws the result.
 *
 * The common case is two equal images. If both images have the same format and palette, equal bytes mean equal colours.
 * Then spans of pixels are compared by memcmp, and in a differing span the common prefix is skipped eight bytes at a
 * time. Otherwise indexed pixels are first looked up in their palette. Only differing pixels are converted to r, g, b
 * and measured. Neighbouring pixels often have the same pair of colours, so the last measurement is kept. Comparing
 * equal pictures thus costs about as much as reading them.
 *
 * Colour distances are computed with sums and products of doubles, and stay squared until the end, so that every
 * machine gets the same number. Anti-aliased edges are detected as in pixelmatch and odiff; see is_antialiased(). */
#include "image_compare.h"
#include "bytes.h"
#include "samples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const image_tolerance exact = {.max_pixels = 0};

static int maximum(int a, int b)
{
    return a > b ? a : b;
}

static int minimum(int a, int b)
{
    return a < b ? a : b;
}

/* ---- Pixels as r, g, b, whatever the image's format ---------------------------------------------------------- */

/* The largest squared distance of two colours with 8 bits per sample. */
#define LARGEST 35215.0

/* Pixels are compared in spans of this length. The samples of a span fit on the stack and into the L1 cache. */
#define SPAN 128

/* Returns `count` pixels from the n-th pixel on as r, g, b of 8 bits: the image's own bytes or, if it is indexed,
 * colours in `room`. */
static const uint8_t *read_rgb_bytes(const image *image, size_t n, int count, uint8_t room[3 * SPAN])
{
    if (image->channels == 3)
        return image->pixels + 3 * n;
    for (int i = 0; i < count; i++)
        memcpy(room + 3 * i, &image->palette.colors[image->pixels[n + (size_t)i]], 3);
    return room;
}

/* Returns whether two spans of pixels have equal colours. Images of 16 bits per sample are not looked at. */
static bool have_equal_rgb_bytes(const image *a, const image *b, size_t n, int count)
{
    uint8_t room[2][3 * SPAN];
    return !a->wide && !b->wide &&
           memcmp(read_rgb_bytes(a, n, count, room[0]), read_rgb_bytes(b, n, count, room[1]), 3 * (size_t)count) == 0;
}

static bool are_samples_equal(const pixel_samples *a, const pixel_samples *b)
{
    return a->of[0] == b->of[0] && a->of[1] == b->of[1] && a->of[2] == b->of[2];
}

/* Returns the squared distance of two colours, in units of IMAGE_DELTA_UNIT. The conversion to YIQ is linear, so the
 * difference of the colours is converted instead of each colour. Equal samples then give exactly 0, and no precision is
 * lost by cancellation. */
static double squared_color_distance(const pixel_samples *a, const pixel_samples *b, int range)
{
    const double r = a->of[0] - b->of[0], g = a->of[1] - b->of[1], u = a->of[2] - b->of[2];
    const double y = 0.29889531 * r + 0.58662247 * g + 0.11448223 * u;
    const double i = 0.59597799 * r - 0.27417610 * g - 0.32180189 * u;
    const double q = 0.21147017 * r - 0.52261711 * g + 0.31114694 * u;
    const double scale = range / 255.0;
    return (0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q) / (LARGEST * scale * scale);
}

/* ---- Anti-aliased edges --------------------------------------------------------------------------------------
 *
 * A pixel lies on an anti-aliased edge if all of these hold:
 * - It has both a darker and a brighter neighbour.
 * - Fewer than three of its neighbours are as bright as the pixel.
 * - Its darkest or its brightest neighbour lies in a patch of one colour, in both images. A pixel lies in a patch if
 *   at least three of its neighbours have its colour.
 * At the image's border, all missing neighbours together count as one equal neighbour.
 *
 * Source: V. Vysniauskas, "Anti-aliased Pixel and Intensity Slope Detector", 2009; also in pixelmatch and odiff.
 */

/* If this many neighbours of a pixel have the pixel's colour, the pixel belongs to a patch of one colour. */
#define PATCH 3

/* A pixel, and the bounds of the part of its 3 x 3 neighbourhood that is inside the image. */
typedef struct window {
    int x, y;
    int left, right, top, bottom;
    /* 1 if a part of the neighbourhood is outside the image; this part then counts as one neighbour of the same
     * colour */
    int equal_outside;
} window;

static window find_window(const image *image, int x, int y)
{
    window w = {.x = x, .y = y};
    w.left = x > 0 ? x - 1 : x;
    w.top = y > 0 ? y - 1 : y;
    w.right = x + 1 < image->width ? x + 1 : x;
    w.bottom = y + 1 < image->height ? y + 1 : y;
    w.equal_outside = w.left == x || w.right == x || w.top == y || w.bottom == y;
    return w;
}

/* Returns the luma (brightness) of a pixel, in units of 1e-8 of a sample value. The result is an integer, so that
 * comparisons are exact. */
static int64_t luma_at(const image *image, int x, int y)
{
    const image_color color = image_color_at(image, x, y);
    return INT64_C(29889531) * color.r + INT64_C(58662247) * color.g + INT64_C(11448223) * color.b;
}

static bool is_in_patch(const image *image, int x, int y)
{
    const window w = find_window(image, x, y);
    const image_color own = image_color_at(image, x, y);
    int equal = w.equal_outside - 1; /* begins with -1, because the loop also counts the pixel itself */
    for (int j = w.top; j <= w.bottom; j++) {
        for (int i = w.left; i <= w.right; i++) {
            const image_color color = image_color_at(image, i, j);
            equal += memcmp(&color, &own, sizeof own) == 0;
        }
    }
    return equal >= PATCH;
}

/* A neighbour of a pixel. `brighter` is how much brighter the neighbour is than the pixel. */
typedef struct neighbor {
    int x, y;
    int64_t brighter;
} neighbor;

/* Find the darkest and the brightest neighbour of a pixel. Of equally bright neighbours take the first, column by
 * column. Returns false if no neighbour is darker, if no neighbour is brighter, or if at least PATCH neighbours are as
 * bright as the pixel. */
static bool find_slope(const image *image, int x, int y, neighbor *darkest, neighbor *brightest)
{
    const window w = find_window(image, x, y);
    const int64_t own = luma_at(image, x, y);
    int equal = w.equal_outside - 1;
    *darkest = *brightest = (neighbor){x, y, 0};
    for (int i = w.left; i <= w.right; i++) {
        for (int j = w.top; j <= w.bottom; j++) {
            const neighbor n = {i, j, luma_at(image, i, j) - own};
            equal += n.brighter == 0;
            if (n.brighter < darkest->brighter)
                *darkest = n;
            if (n.brighter > brightest->brighter)
                *brightest = n;
        }
    }
    return equal < PATCH && darkest->brighter < 0 && brightest->brighter > 0;
}

static bool is_on_antialiased_edge(const image *of, const image *other, int x, int y)
{
    neighbor darkest, brightest;
    return find_slope(of, x, y, &darkest, &brightest) &&
           ((is_in_patch(of, darkest.x, darkest.y) && is_in_patch(other, darkest.x, darkest.y)) ||
            (is_in_patch(of, brightest.x, brightest.y) && is_in_patch(other, brightest.x, brightest.y)));
}

/* Returns whether a pixel lies on an anti-aliased edge of at least one of the two images. Both images have the same
 * size. Reads the 5 x 5 pixels around the pixel. */
static bool is_antialiased(const image *a, const image *b, int x, int y)
{
    return is_on_antialiased_edge(a, b, x, y) || is_on_antialiased_edge(b, a, x, y);
}

/* ---- Counting ------------------------------------------------------------------------------------------------ */

/* A band of two images: the same consecutive rows of both images. */
typedef struct rows {
    const image *a, *b;
    int first; /* number of the band's first row in the whole images */
} rows;

/* Returns whether equal bytes of the two images mean equal colours. Palettes can be compared as a whole, because unused
 * entries are zero. */
static bool have_same_storage(const image *a, const image *b)
{
    if (a->channels != b->channels || a->wide != b->wide)
        return false;
    return a->channels == 3 || memcmp(a->palette.colors, b->palette.colors, sizeof a->palette.colors) == 0;
}

static int largest_channel_difference(const pixel_samples *a, const pixel_samples *b)
{
    int largest = 0;
    for (int i = 0; i < 3; i++)
        largest = maximum(largest, abs(a->of[i] - b->of[i]));
    return largest;
}

/* Measure the difference of two colours. Store the results in c->last_square and c->last_channel. */
static void measure_colors(image_comparison *c, const pixel_samples *a, const pixel_samples *b)
{
    if (memcmp(a, c->last[0], sizeof *a) == 0 && memcmp(b, c->last[1], sizeof *b) == 0)
        return;
    memcpy(c->last[0], a, sizeof *a);
    memcpy(c->last[1], b, sizeof *b);
    c->last_square = squared_color_distance(a, b, c->difference.channel_range);
    c->last_channel = largest_channel_difference(a, b);
}

static void add_to_tally(image_tally *tally, int x, int y, const image_comparison *c)
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
    tally->largest_channel = maximum(tally->largest_channel, c->last_channel);
    tally->min_x = minimum(tally->min_x, x);
    tally->max_x = maximum(tally->max_x, x);
    tally->max_y = y; /* the latest row has the largest y, because rows are added from the top down */
}

typedef enum verdict { COUNTED, IGNORED, CLOSE, ANTIALIASED } verdict;

/* Decide whether a differing pixel is counted, ignored or forgiven, and why. `y` is the pixel's row in the band,
 * `square` the squared distance of its two colours, `channel` the largest difference of their samples. */
static verdict judge_pixel(const image_tolerance *t, const rows *r, int x, int y, double square, int channel)
{
    if (image_is_pixel_ignored(t, r->a->width, x, r->first + y))
        return IGNORED;
    if (square <= t->max_delta * t->max_delta || channel <= t->max_channel)
        return CLOSE;
    return t->antialias && is_antialiased(r->a, r->b, x, y) ? ANTIALIASED : COUNTED;
}

static void count_pixel(image_comparison *c, const rows *r, int x, int y, const pixel_samples *a,
                        const pixel_samples *b)
{
    image_difference *difference = &c->difference;
    measure_colors(c, a, b);
    const verdict v = judge_pixel(c->tolerance, r, x, y, c->last_square, c->last_channel);
    difference->ignored += v == IGNORED;
    difference->close += v == CLOSE;
    difference->antialiased += v == ANTIALIASED;
    if (v != IGNORED)
        add_to_tally(&difference->unlike, x, r->first + y, c);
    if (v == COUNTED)
        add_to_tally(&difference->counted, x, r->first + y, c);
}

/* Count the differing pixels in a span of `count` pixels that begins at (x, y). */
static void count_span(image_comparison *c, const rows *r, int x, int y, int count)
{
    const size_t n = (size_t)y * (size_t)r->a->width + (size_t)x, size = image_pixel_size(r->a);
    const uint8_t *at_a = r->a->pixels + n * size, *at_b = r->b->pixels + n * image_pixel_size(r->b);
    if (c->same_storage ? memcmp(at_a, at_b, (size_t)count * size) == 0 : have_equal_rgb_bytes(r->a, r->b, n, count))
        return;
    pixel_samples a[SPAN], b[SPAN];
    for (int i = 0, some; i < count; i += some) {
        some = count - i;
        if (c->same_storage) {
            const size_t at = (size_t)i * size;
            i += (int)(bytes_common_prefix_length(at_a + at, at_b + at, (size_t)some * size) / size);
            some = i < count;
        }
        read_samples(r->a, n + (size_t)i, some, c->difference.channel_range, a);
        read_samples(r->b, n + (size_t)i, some, c->difference.channel_range, b);
        for (int j = 0; j < some; j++)
            if (!are_samples_equal(&a[j], &b[j])) /* the indices differ, but they may have the same colour */
                count_pixel(c, r, x + i + j, y, &a[j], &b[j]);
    }
}

image_comparison image_begin_comparison(const image *a, const image *b, const image_tolerance *tolerance)
{
    static const image_tally none = {.worst_x = -1, .worst_y = -1, .min_x = -1, .min_y = -1, .max_x = -1, .max_y = -1};
    return (image_comparison){
        .tolerance = tolerance,
        .difference = {.same_size = a->width == b->width && a->height == b->height,
                       .area = (uint64_t)a->width * (uint64_t)a->height,
                       .channel_range = common_sample_range(a, b),
                       .unlike = none,
                       .counted = none},
        .same_storage = have_same_storage(a, b),
    };
}

void image_compare_band(image_comparison *c, const image *a, const image *b)
{
    const rows r = {a, b, c->y};
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x += SPAN)
            count_span(c, &r, x, y, minimum(SPAN, a->width - x));
    c->y += a->height;
}

image_difference image_end_comparison(const image_comparison *c)
{
    image_difference difference = c->difference;
    difference.unlike.worst_delta = sqrt(difference.unlike.worst_delta);
    difference.counted.worst_delta = sqrt(difference.counted.worst_delta);
    return difference;
}

image_difference image_compare_within(const image *a, const image *b, const image_tolerance *tolerance)
{
    image_comparison c = image_begin_comparison(a, b, tolerance);
    if (c.difference.same_size)
        image_compare_band(&c, a, b);
    return image_end_comparison(&c);
}

image_difference image_compare(const image *a, const image *b)
{
    return image_compare_within(a, b, &exact);
}

/* ---- Judging ------------------------------------------------------------------------------------------------- */

bool image_has_no_difference(const image_difference *difference)
{
    return difference->same_size && difference->unlike.pixels == 0 && difference->ignored == 0;
}

bool image_is_within_tolerance(const image_difference *difference, const image_tolerance *tolerance)
{
    const bool invisible = tolerance->flip && difference->has_flip && difference->flip.mean <= tolerance->max_flip;
    /* The factor makes up for rounding: 0.07 % of 10000 pixels are 7 pixels, not 6.9999. */
    const double share = tolerance->max_share * (double)difference->area * (1 + 1e-12);
    const uint64_t counted = difference->counted.pixels;
    return difference->same_size && (invisible || counted <= tolerance->max_pixels || (double)counted <= share);
}

/* ---- The picture of the difference --------------------------------------------------------------------------- */

/* The indices of the difference picture's palette: first greys, then one index for forgiven pixels, one for pixels that
 * only one image has, and colours for counted pixels, which show the size of the difference. */
enum { GREYS = 64, FORGIVEN = GREYS, OUTSIDE, HEAT, HEATS = 256 - HEAT };

static const image_color FORGIVEN_COLOR = {70, 140, 255}, OUTSIDE_COLOR = {74, 46, 104};

/* Colours for counted pixels, from small differences to large ones. These colours differ from the greys even under
 * colour blindness. */
static const image_color HEAT_COLORS[] = {{255, 96, 40}, {255, 190, 20}, {255, 255, 214}};

static uint8_t interpolate(int from, int to, int part, int whole)
{
    return (uint8_t)(from + (to - from) * part / whole);
}

static image_color heat_color(int i)
{
    const int half = HEATS / 2, which = i < half ? 0 : 1, part = i - which * half;
    const image_color *from = &HEAT_COLORS[which], *to = from + 1;
    return (image_color){interpolate(from->r, to->r, part, half), interpolate(from->g, to->g, part, half),
                         interpolate(from->b, to->b, part, half)};
}

image_palette image_make_difference_palette(void)
{
    image_palette palette = {.count = 256};
    for (int i = 0; i < GREYS; i++) {
        const uint8_t grey = interpolate(4, 92, i, GREYS - 1);
        palette.colors[i] = (image_color){grey, grey, grey};
    }
    palette.colors[FORGIVEN] = FORGIVEN_COLOR;
    palette.colors[OUTSIDE] = OUTSIDE_COLOR;
    for (int i = 0; i < HEATS; i++)
        palette.colors[HEAT + i] = heat_color(i);
    return palette;
}

static uint8_t grey_index(const pixel_samples *p, int range)
{
    const double luma = (77.0 * p->of[0] + 150.0 * p->of[1] + 29.0 * p->of[2]) / (256.0 * range);
    return (uint8_t)((GREYS - 1) * sqrt(luma)); /* the square root keeps dark pictures recognizable */
}

/* Return the index for a pixel with the colours p and q. */
static uint8_t difference_index(const rows *r, const image_tolerance *tolerance, int x, int y, const pixel_samples *p,
                                const pixel_samples *q)
{
    const double square = squared_color_distance(p, q, common_sample_range(r->a, r->b));
    if (judge_pixel(tolerance, r, x, y, square, largest_channel_difference(p, q)) != COUNTED)
        return FORGIVEN;
    /* With the square root of the distance, half of the colours are left for barely visible differences. `square` is
     * the squared distance, so two square roots are taken. */
    return (uint8_t)(HEAT + (int)((HEATS - 1) * sqrt(sqrt(square))));
}

void image_draw_difference_row(const image *a, const image *b, const image_tolerance *tolerance, int y, uint8_t *row)
{
    const int range = common_sample_range(a, b), longest = maximum(a->width, b->width);
    const int common = y >= a->height || y >= b->height ? 0 : minimum(a->width, b->width);
    const rows r = {a, b, 0};
    pixel_samples p[SPAN], q[SPAN];
    if (a->width != b->width || a->height != b->height)
        tolerance = &exact;
    for (int x = 0; x < common; x += SPAN) {
        const int count = minimum(SPAN, common - x);
        read_samples(a, (size_t)y * (size_t)a->width + (size_t)x, count, range, p);
        read_samples(b, (size_t)y * (size_t)b->width + (size_t)x, count, range, q);
        for (int i = 0; i < count; i++)
            row[x + i] = are_samples_equal(&p[i], &q[i]) ? grey_index(&p[i], range)
                                                         : difference_index(&r, tolerance, x + i, y, &p[i], &q[i]);
    }
    memset(row + common, OUTSIDE, (size_t)(longest - common));
}
