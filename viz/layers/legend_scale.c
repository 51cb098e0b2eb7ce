/* SPDX-License-Identifier: MIT */
/* legend_scale.c - draws a colour bar across the text column, with round numbers below it.
 *
 * The problem: the numbers must be round, stand below their place on the bar, and not touch each other. How many
 * numbers fit depends on their length when printed, and the length depends on the step between them. So the code tries
 * sets of about five, four, three and two numbers, and finally a single number. For each set it takes the next round
 * step (1, 2 or 5 times a power of ten) and prints the numbers. It keeps the first set with room for a character
 * between all numbers. A logarithmic bar has fixed numbers: every second power of two. A bar whose ends are equal or
 * not finite has one number in the middle.
 *
 * If numbers outside the bar have the colours of its ends, the bar tapers to a point at both ends. */
#include "legend.h"

#include <math.h>
#include <string.h>

#define MOST_NUMBERS 5
#define DIGITS 9 /* significant digits of a printed number */

/* A number below the bar, with its tick mark. */
typedef struct scale_number {
    double part; /* the number's position on the bar, from 0 (left end) to 1 */
    char text[NUMBER_TEXT];
} scale_number;

typedef struct scale_numbers {
    scale_number items[MOST_NUMBERS + 2];
    int count;
} scale_numbers;

static void add_number(scale_numbers *m, double part, double value)
{
    if (m->count < MOST_NUMBERS + 2) {
        m->items[m->count].part = part;
        number_format(value, DIGITS, m->items[m->count++].text);
    }
}

/* Place numbers at every second power of two below a logarithmic bar: low, 4 low, 16 low ... The last number gets a
 * "+", because larger numbers have the same colour. */
static scale_numbers make_numbers_at_powers_of_two(const legend_scale *scale)
{
    scale_numbers m = {.count = 0};
    int powers = 0;
    for (double at = scale->low; at < scale->high; at *= 2)
        powers++;
    for (int power = 0; power <= powers; power += 2)
        add_number(&m, (double)power / powers, ldexp(scale->low, power));
    if (m.count)
        strcat(m.items[m.count - 1].text, "+");
    return m;
}

static scale_numbers make_numbers_at_round_steps(const legend_scale *scale, int count)
{
    scale_numbers m = {.count = 0};
    const double extent = scale->high - scale->low, step = number_round_up_to_1_2_5(extent / count);
    const double first = step > 0 ? ceil(scale->low / step) : 0, last = step > 0 ? floor(scale->high / step) : -1;
    for (double i = first; i <= last && i < first + MOST_NUMBERS + 1; i++) /* adding 0.0 turns -0 into 0 */
        add_number(&m, (i * step - scale->low) / extent, i * step + 0.0);
    return m;
}

/* Return the x of a number's left end, in pixels. The number is centred below its tick mark, but stays within the bar.
 */
static int left_end_of_number(const pen *p, const scale_number *m, int width)
{
    const int size = (int)strlen(m->text) * p->text.width, left = (int)(m->part * width) - size / 2;
    return left < 0 ? 0 : left + size > width ? width - size : left;
}

/* Return whether all numbers fit below the bar with room for a character between them. */
static bool do_numbers_fit(const pen *p, const scale_numbers *m, int width)
{
    for (int i = 0; i < m->count; i++) {
        const int left = left_end_of_number(p, &m->items[i], width), letter = p->text.width;
        if (left < 0 || (i > 0 && left < left_end_of_number(p, &m->items[i - 1], width) +
                                             ((int)strlen(m->items[i - 1].text) + 1) * letter))
            return false;
    }
    return true;
}

static scale_numbers choose_numbers(const pen *p, const legend_scale *scale, int width)
{
    scale_numbers m = {.count = 0};
    if (scale->doubling)
        return make_numbers_at_powers_of_two(scale);
    if (!(scale->low < scale->high) || !isfinite(scale->high - scale->low)) {
        add_number(&m, 0.5, scale->low / 2 + scale->high / 2);
        return m;
    }
    for (int count = MOST_NUMBERS; count > 0; count--) {
        m = make_numbers_at_round_steps(scale, count);
        if (m.count > 0 && do_numbers_fit(p, &m, width))
            return m;
    }
    m.count = 0;
    return m;
}

void write_scale(pen *p, const legend_scale *scale)
{
    const lettering *text = &p->text;
    const int width = LAYOUT_LETTERS * text->width, high = text->height / 2,
              dot = p->rows             ? 2
                    : text->height < 24 ? 1
                                        : text->height / 12;
    const scale_numbers m = choose_numbers(p, scale, width);
    for (int x = 0; x < width; x += dot) {
        const int left = width - dot - x, from_end = x < left ? x : left > 0 ? left : 0;
        const int pointed = (2 * (from_end / dot) + 1) * dot, tall = scale->pointed && pointed < high ? pointed : high;
        fill_rectangle_in_color(p, x, text->height / 4 + (high - tall) / 2, dot, tall,
                                theme_ramp_color((x + 0.5 * dot) / width));
    }
    for (int i = 0; i < m.count; i++) {
        int x = (int)(m.items[i].part * width);
        x = x > width - dot ? width - dot : x;
        fill_rectangle(p, x, text->height / 4 + high, dot, text->height / 4, ROLE_FAINT);
        p->y += text->line;
        write_text_at(p, left_end_of_number(p, &m.items[i], width), ROLE_FAINT, m.items[i].text);
        p->y -= text->line;
    }
}
