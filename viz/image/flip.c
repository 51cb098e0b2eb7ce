/* SPDX-License-Identifier: MIT */
/* flip.c - FLIP: how visible is the difference of two images to a person who sees them in alternation?
 *
 * Counting differing pixels finds everything and says nothing about what a person sees: noise of one level, which is
 * invisible, changes every pixel, and a missing line few. FLIP models the person. Its answer for a pixel is a number
 * from 0, no visible difference, to 1:
 * 1. Colour. Blur luminance, red-green and blue-yellow as the eye does at the distance of the display, convert the
 *    result to CIELAB, and take the HyAB distance: |L1 - L2| plus the distance in the plane (a, b). A power of 0.7 and
 *    a line with a bend map it to 0..1.
 * 2. Features. Find edges and points (first and second derivatives of a Gaussian) in the luminance of both images, and
 *    take the larger difference of their strengths.
 * 3. The value is color^(1 - sqrt(feature)): a difference of sharpness makes a difference of colour more visible.
 * The value of an image is the mean of its pixels.
 *
 * Why not SSIM: it compares statistics of grey windows of a fixed size, knows neither colour nor distance, and its
 * values have no scale that a person could name.
 *
 * The images are processed in strips of 256 columns, from the top down. For each row of a strip, the passes along the
 * row are computed once and kept in a ring of as many rows as the filters are high. The passes along the columns read
 * the ring. A strip thus takes 300 kB, which fits the L2 cache, however large the image is. Where the two images are
 * equal in all rows of the ring, the value is 0, and nothing more is computed. Cost: about 140 products a pixel and
 * image at 67 pixels per degree; a megapixel takes 60 ms if all pixels differ, and 12 ms if few do.
 *
 * Source: P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom and M. D. Fairchild, "FLIP: A Difference
 * Evaluator for Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020.
 */
#include "flip.h"
#include "flip_color.h"
#include "flip_filter.h"

#include <stdlib.h>

/* Pixels left and right of a strip that its filters read. */
enum { MARGIN = (FLIP_MOST_RADIUS + FLIP_STEP - 1) / FLIP_STEP * FLIP_STEP, PADDED = FLIP_STRIP + 2 * MARGIN };

/* The results of the passes along a row of a strip. */
typedef struct passes {
    float luminance[FLIP_STRIP], red_green[FLIP_STRIP], blue_yellow[2][FLIP_STRIP];
    float smooth[FLIP_STRIP], edge[FLIP_STRIP], point[FLIP_STRIP];
} passes;

/* A row of a strip with its margins, before the passes. */
typedef struct padded_row {
    pixel_samples samples[PADDED];
    float y[PADDED], x[PADDED], z[PADDED];
} padded_row;

typedef struct strip {
    const image *images[2];
    const image_tolerance *tolerance;
    flip_kernels kernels;
    int range;          /* the largest sample */
    int height;         /* of the images */
    int left, count;    /* the columns of the strip */
    int last_different; /* the last row, with margins, whose samples differ; hugely negative: none yet */
    passes *ring[2];    /* of each image the rows y modulo `size` */
    const passes *near[2][2 * MARGIN + 1]; /* near[side][MARGIN + k]: the k-th row below the row that is computed */
    int size;                              /* 2 * kernels.reach + 1 */
    float *linear;                         /* see flip_fill_linear_table() */
    padded_row rows[2];
    float values[FLIP_STRIP];
} strip;

static int clamp(int value, int least, int most)
{
    return value < least ? least : value > most ? most : value;
}

/* ---- Passes along the rows --------------------------------------------------------------------------------------- */

static bool has_ignored_pixels(const image_tolerance *tolerance)
{
    return tolerance->ignored_count > 0 || tolerance->ignored_mask;
}

/* Read the samples of a row with its margins. Beyond the image, the pixel at its border is repeated. */
static void read_padded_row(strip *s, int y, int side)
{
    const image *from = s->images[side];
    const int first = s->left - s->kernels.reach, end = s->left + s->count + s->kernels.reach;
    const int inner = clamp(first, 0, from->width - 1), inner_end = clamp(end, 1, from->width);
    pixel_samples *samples = s->rows[side].samples;
    read_samples(from, (size_t)y * (size_t)from->width + (size_t)inner, inner_end - inner, s->range,
                 samples + (inner - first));
    for (int x = first; x < inner; x++)
        samples[x - first] = samples[inner - first];
    for (int x = inner_end; x < end; x++)
        samples[x - first] = samples[inner_end - 1 - first];
}

/* Replace the ignored pixels of the second row by those of the first row. */
static void copy_ignored_pixels(strip *s, int y)
{
    const int first = s->left - s->kernels.reach, end = s->left + s->count + s->kernels.reach;
    const int width = s->images[0]->width;
    for (int x = first; x < end; x++)
        if (image_is_pixel_ignored(s->tolerance, width, clamp(x, 0, width - 1), y))
            s->rows[1].samples[x - first] = s->rows[0].samples[x - first];
}

/* Point middle[k] to the samples from column k on, k from -reach to reach. */
static void find_taps_along(const float *row, int reach, const float **middle)
{
    for (int k = -reach; k <= reach; k++)
        middle[k] = row + reach + k;
}

static void pass_along_row(strip *s, int y, int side)
{
    const flip_kernels *k = &s->kernels;
    const float *taps[2 * MARGIN + 1], **middle = taps + MARGIN;
    padded_row *row = &s->rows[side];
    passes *to = &s->ring[side][y % s->size];
    flip_convert_samples(row->samples, s->linear, s->count + 2 * k->reach, row->y, row->x, row->z);
    find_taps_along(row->y, k->reach, middle);
    filter_even(&k->luminance, middle, s->count, to->luminance);
    filter_even(&k->smooth, middle, s->count, to->smooth);
    filter_even_and_odd(&k->point, &k->edge, middle, s->count, to->point, to->edge);
    find_taps_along(row->x, k->reach, middle);
    filter_even(&k->red_green, middle, s->count, to->red_green);
    find_taps_along(row->z, k->reach, middle);
    filter_two_even(&k->blue_yellow[0], &k->blue_yellow[1], middle, s->count, to->blue_yellow[0], to->blue_yellow[1]);
}

static void add_row(strip *s, int y)
{
    const size_t size = (size_t)(s->count + 2 * s->kernels.reach) * sizeof *s->rows[0].samples;
    read_padded_row(s, y, 0);
    read_padded_row(s, y, 1);
    if (has_ignored_pixels(s->tolerance))
        copy_ignored_pixels(s, y);
    pass_along_row(s, y, 0);
    if (memcmp(s->rows[0].samples, s->rows[1].samples, size) == 0) {
        s->ring[1][y % s->size] = s->ring[0][y % s->size];
    } else {
        pass_along_row(s, y, 1);
        s->last_different = y;
    }
}

/* ---- Passes along the columns ------------------------------------------------------------------------------------ */

static void find_near_rows(strip *s, int y)
{
    for (int k = -s->kernels.reach; k <= s->kernels.reach; k++) {
        const int slot = clamp(y + k, 0, s->height - 1) % s->size;
        s->near[0][MARGIN + k] = &s->ring[0][slot];
        s->near[1][MARGIN + k] = &s->ring[1][slot];
    }
}

/* Point taps[MARGIN + k] to the member of the k-th near row that is at `offset`. */
static void find_taps(const strip *s, int side, size_t offset, const float **taps)
{
    for (int k = MARGIN - s->kernels.reach; k <= MARGIN + s->kernels.reach; k++)
        taps[k] = (const float *)(const void *)((const char *)s->near[side][k] + offset);
}

static void find_colors(const strip *s, int side, flip_lab *colors)
{
    const flip_kernels *k = &s->kernels;
    const float *taps[2 * MARGIN + 1], **middle = taps + MARGIN;
    flip_opponent blurred;
    find_taps(s, side, offsetof(passes, luminance), taps);
    filter_even(&k->luminance, middle, s->count, blurred.y);
    find_taps(s, side, offsetof(passes, red_green), taps);
    filter_even(&k->red_green, middle, s->count, blurred.x);
    find_taps(s, side, offsetof(passes, blue_yellow[0]), taps);
    filter_even(&k->blue_yellow[0], middle, s->count, blurred.z);
    find_taps(s, side, offsetof(passes, blue_yellow[1]), taps);
    filter_even_add(&k->blue_yellow[1], middle, s->count, blurred.z);
    flip_convert_to_lab(&blurred, s->count, colors);
}

static void find_features(const strip *s, int side, float *edges, float *points)
{
    const flip_kernels *k = &s->kernels;
    const float *taps[2 * MARGIN + 1], **middle = taps + MARGIN;
    float edges_down[FLIP_STRIP], points_down[FLIP_STRIP];
    find_taps(s, side, offsetof(passes, edge), taps);
    filter_even(&k->smooth, middle, s->count, edges);
    find_taps(s, side, offsetof(passes, point), taps);
    filter_even(&k->smooth, middle, s->count, points);
    find_taps(s, side, offsetof(passes, smooth), taps);
    filter_even_and_odd(&k->point, &k->edge, middle, s->count, points_down, edges_down);
    flip_find_lengths(edges, edges_down, s->count);
    flip_find_lengths(points, points_down, s->count);
}

static void find_values(strip *s, int y)
{
    flip_lab colors[2];
    float features[4][FLIP_STRIP];
    if (s->last_different < y - s->kernels.reach) {
        memset(s->values, 0, sizeof s->values);
        return;
    }
    find_near_rows(s, y);
    for (int side = 0; side < 2; side++) {
        find_colors(s, side, &colors[side]);
        find_features(s, side, features[2 * side], features[2 * side + 1]);
    }
    flip_combine(colors, features, s->count, s->values);
}

/* ---- The image --------------------------------------------------------------------------------------------------- */

/* The sum and the number of the pixels that are not ignored. */
typedef struct totals {
    double sum;
    uint64_t count;
} totals;

static void clear_ignored_values(strip *s, int y, totals *all)
{
    for (int i = 0; i < s->count; i++)
        if (image_is_pixel_ignored(s->tolerance, s->images[0]->width, s->left + i, y)) {
            s->values[i] = 0;
            all->count--;
        }
}

/* Four sums, because one would wait for each addition. */
static double add_values(const float *values, int count)
{
    double sums[4] = {0, 0, 0, 0};
    for (int i = 0; i < count; i++)
        sums[i % 4] += (double)values[i];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/* Strips are processed one after the other, so that a pixel further up may come later. */
static void find_worst(const strip *s, int y, image_flip *flip)
{
    for (int i = 0; i < s->count; i++) {
        const double value = (double)s->values[i];
        if (value > flip->worst || (value == flip->worst && value > 0 && y < flip->worst_y))
            *flip = (image_flip){.worst = value, .worst_x = s->left + i, .worst_y = y};
    }
}

/* Add the values of row y, and store them in the map. */
static void count_row(strip *s, int y, totals *all, image_flip *flip, uint8_t *map)
{
    all->count += (uint64_t)s->count;
    if (has_ignored_pixels(s->tolerance))
        clear_ignored_values(s, y, all);
    all->sum += add_values(s->values, s->count);
    find_worst(s, y, flip);
    if (map)
        map += (size_t)y * (size_t)s->images[0]->width + (size_t)s->left;
    for (int i = 0; map && i < s->count; i++)
        map[i] = (uint8_t)(255 * s->values[i] + 0.5f);
}

static void measure_strip(strip *s, totals *all, image_flip *flip, uint8_t *map)
{
    const int reach = s->kernels.reach;
    s->last_different = INT32_MIN;
    for (int y = 0; y < s->height + reach; y++) {
        if (y < s->height)
            add_row(s, y);
        if (y >= reach) {
            find_values(s, y - reach);
            count_row(s, y - reach, all, flip, map);
        }
    }
}

static strip *create_strip(const image *a, const image *b, const image_tolerance *tolerance)
{
    strip *s = calloc(1, sizeof *s);
    if (!s)
        return NULL;
    s->images[0] = a;
    s->images[1] = b;
    s->tolerance = tolerance;
    s->height = a->height;
    s->range = common_sample_range(a, b);
    s->kernels = flip_make_kernels(tolerance->pixels_per_degree);
    s->size = 2 * s->kernels.reach + 1;
    s->linear = malloc(((size_t)s->range + 1) * sizeof *s->linear);
    for (int i = 0; i < 2; i++)
        s->ring[i] = malloc((size_t)s->size * sizeof *s->ring[i]);
    if (s->linear)
        flip_fill_linear_table(s->range, s->linear);
    return s;
}

static void free_strip(strip *s)
{
    if (s) {
        free(s->linear);
        free(s->ring[0]);
        free(s->ring[1]);
    }
    free(s);
}

bool image_measure_flip(const image *a, const image *b, const image_tolerance *tolerance, uint8_t *map,
                        image_flip *flip)
{
    strip *s = create_strip(a, b, tolerance);
    const bool ok = s && s->linear && s->ring[0] && s->ring[1];
    totals all = {0, 0};
    *flip = (image_flip){.worst_x = -1, .worst_y = -1};
    for (int left = 0; ok && left < a->width; left += FLIP_STRIP) {
        s->left = left;
        s->count = clamp(a->width - left, 1, FLIP_STRIP);
        measure_strip(s, &all, flip, map);
    }
    flip->mean = all.count ? all.sum / (double)all.count : 0;
    free_strip(s);
    return ok;
}
