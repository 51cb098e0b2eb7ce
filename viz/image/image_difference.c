/* draw_difference.c - where two images differ, and how much: hot pixels over a dim copy of the first.
 *
 * The smallest difference is as bright as a warning, and the scale above it follows the square root of the delta: half
 * of it is for what an eye would hardly see.
 */
#include "antialias.h"
#include "image_compare.h"

#include <math.h>
#include <string.h>

/* Indices of the palette: greys, what is forgiven, what only one of both has, and the heat of a difference. */
enum { GREYS = 64, FORGIVEN = GREYS, OUTSIDE, HEAT, HEATS = 256 - HEAT };

static const image_color FORGIVEN_COLOR = {70, 140, 255}, OUTSIDE_COLOR = {74, 46, 104};

/* Apart from the greys for colour-blind eyes too, each brighter than the one before. */
static const image_color HEAT_COLORS[] = {{255, 96, 40}, {255, 190, 20}, {255, 255, 214}};

static uint8_t between(int from, int to, int part, int whole)
{
    return (uint8_t)(from + (to - from) * part / whole);
}

static image_color heat_color(int i)
{
    const int half = HEATS / 2, which = i < half ? 0 : 1, part = i - which * half;
    const image_color *from = &HEAT_COLORS[which], *to = from + 1;
    return (image_color){between(from->r, to->r, part, half), between(from->g, to->g, part, half),
                         between(from->b, to->b, part, half)};
}

image_palette image_difference_palette(void)
{
    image_palette palette = {.count = 256};
    for (int i = 0; i < GREYS; i++) {
        const uint8_t grey = between(4, 92, i, GREYS - 1);
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
    return (uint8_t)((GREYS - 1) * sqrt(luma)); /* so that dark pictures stay legible */
}

static uint8_t unlike_index(const image *a, const image *b, const image_tolerance *tolerance, int x, int y,
                            double square)
{
    if (image_is_ignored(tolerance, a->width, x, y) || square <= tolerance->max_delta * tolerance->max_delta ||
        (tolerance->antialias && antialias_explains(a, b, x, y)))
        return FORGIVEN;
    return (uint8_t)(HEAT + (int)((HEATS - 1) * sqrt(sqrt(square))));
}

void image_difference_row(const image *a, const image *b, const image_tolerance *tolerance, int y, uint8_t *row)
{
    pixel_samples span_a[SPAN], span_b[SPAN];
    const int range = samples_range(a, b), longest = a->width > b->width ? a->width : b->width;
    const int common = y >= a->height || y >= b->height ? 0 : a->width + b->width - longest;
    const bool same_size = a->width == b->width && a->height == b->height;
    for (int x = 0; x < common; x += SPAN) {
        const int count = common - x < SPAN ? common - x : SPAN;
        samples_read(a, (size_t)y * (size_t)a->width + (size_t)x, count, range, span_a);
        samples_read(b, (size_t)y * (size_t)b->width + (size_t)x, count, range, span_b);
        for (int i = 0; i < count; i++) {
            static const image_tolerance exact = {.max_pixels = 0};
            if (samples_equal(&span_a[i], &span_b[i]))
                row[x + i] = grey_index(&span_a[i], range);
            else
                row[x + i] = unlike_index(a, b, same_size ? tolerance : &exact, x + i, y,
                                          delta_square(&span_a[i], &span_b[i], range));
        }
    }
    memset(row + common, OUTSIDE, (size_t)(longest - common));
}
