/* SPDX-License-Identifier: MIT */
/* tolerance.c - reads tolerances by name, and joins them. */
#include "tolerance.h"
#include "error.h"
#include "flip.h"
#include "number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Values -------------------------------------------------------------------------------------------------- */

typedef enum reading_status { READ_DONE, READ_INVALID, READ_NO_MEMORY } reading_status;
typedef reading_status tolerance_reader(const char *text, image_tolerance *into);

static reading_status read_number(const char *text, double least, double most, double *into)
{
    double value;
    if (!numbers_parse(text, &value, 1) || !(value >= least && value <= most))
        return READ_INVALID;
    *into = value;
    return READ_DONE;
}

/* Read a number of pixels, or a percentage such as "0.5%". */
static reading_status read_max_pixels(const char *text, image_tolerance *into)
{
    uint64_t value;
    char number[32];
    const size_t length = strlen(text);
    if (length > 0 && text[length - 1] == '%') {
        snprintf(number, sizeof number, "%.*s", length < sizeof number ? (int)length - 1 : 0, text);
        const reading_status status = read_number(number, 0, 100, &into->max_share);
        into->max_share /= 100;
        return status;
    }
    if (!whole_number_parse(&text, UINT32_MAX, &value) || *text)
        return READ_INVALID;
    into->max_pixels = value;
    return READ_DONE;
}

static reading_status read_max_delta(const char *text, image_tolerance *into)
{
    return read_number(text, 0, 1, &into->max_delta);
}

static reading_status read_max_channel(const char *text, image_tolerance *into)
{
    uint64_t value;
    if (!whole_number_parse(&text, UINT16_MAX, &value) || *text)
        return READ_INVALID;
    into->max_channel = (int)value;
    return READ_DONE;
}

static reading_status read_antialias(const char *text, image_tolerance *into)
{
    (void)text;
    into->antialias = true;
    return READ_DONE;
}

static reading_status read_flip(const char *text, image_tolerance *into)
{
    into->flip = true;
    return read_number(text, 0, 1, &into->max_flip);
}

static reading_status read_resolution(const char *text, image_tolerance *into)
{
    return read_number(text, FLIP_LEAST_PIXELS_PER_DEGREE, FLIP_MOST_PIXELS_PER_DEGREE, &into->pixels_per_degree);
}

static reading_status read_rectangle(const char *text, image_tolerance *into)
{
    uint64_t values[4] = {0};
    bool ok = true;
    for (int i = 0; ok && i < 4; i++, text++)
        ok = whole_number_parse(&text, INT32_MAX, &values[i]) && *text == (i < 3 ? ',' : 0);
    if (!ok || values[2] == 0 || values[3] == 0)
        return READ_INVALID;
    image_rectangle *grown = realloc((void *)into->ignored, (into->ignored_count + 1) * sizeof *grown);
    if (!grown)
        return READ_NO_MEMORY;
    grown[into->ignored_count++] = (image_rectangle){(int)values[0], (int)values[1], (int)values[2], (int)values[3]};
    into->ignored = grown;
    return READ_DONE;
}

/* ---- The table ----------------------------------------------------------------------------------------------- */

#define FRACTION "a number from 0 to 1"

static const struct {
    const char *name;
    const char *takes; /* the valid values; null: the tolerance takes no value */
    tolerance_reader *read;
} tolerances[] = {
    {"max-pixels", "a whole number from 0 to 4294967295, or a percentage such as 0.5%", read_max_pixels},
    {"max-delta", FRACTION, read_max_delta},
    {"max-channel", "a whole number from 0 to 65535", read_max_channel},
    {"antialias", NULL, read_antialias},
    {"flip", FRACTION, read_flip},
    {"pixels-per-degree",
     "a number from " NUMBER_DIGITS(FLIP_LEAST_PIXELS_PER_DEGREE) " to " NUMBER_DIGITS(FLIP_MOST_PIXELS_PER_DEGREE),
     read_resolution},
    {"ignore",
     "left, top, width and height in pixels, such as 10,20,300,40, each at most 2147483647, width and height at "
     "least 1",
     read_rectangle},
};
#define TOLERANCES ((int)(sizeof tolerances / sizeof tolerances[0]))

const char *tolerance_name(int i)
{
    return i < TOLERANCES ? tolerances[i].name : NULL;
}

int tolerance_find(const char *name)
{
    for (int i = 0; i < TOLERANCES; i++)
        if (strcmp(tolerances[i].name, name) == 0)
            return i;
    return -1;
}

bool tolerance_read(int i, const char *text, const char *place, image_tolerance *into, octreel_error *error)
{
    const char *name = tolerances[i].name, *takes = tolerances[i].takes;
    if (!takes && text)
        return error_set(error, "%s%s takes no value", place, name);
    switch (takes && !text ? READ_INVALID : tolerances[i].read(text, into)) {
    case READ_DONE:
        return true;
    case READ_INVALID:
        return error_set(error, "%s%s takes %s, not \"%s\"", place, name, takes, text ? text : "");
    default:
        return error_no_memory(error);
    }
}

void tolerance_release(image_tolerance *tolerance)
{
    free((void *)tolerance->ignored);
    *tolerance = (image_tolerance){0};
}

/* ---- Comparing and joining ----------------------------------------------------------------------------------- */

bool tolerance_is_exact(const image_tolerance *t)
{
    return t->max_pixels == 0 && t->max_share == 0 && t->max_delta == 0 && t->max_channel == 0 && !t->antialias &&
           !t->flip && t->ignored_count == 0;
}

static double larger(double a, double b)
{
    return a > b ? a : b;
}

void tolerance_widen(image_tolerance *t, const image_tolerance *by)
{
    t->max_pixels = t->max_pixels > by->max_pixels ? t->max_pixels : by->max_pixels;
    t->max_share = larger(t->max_share, by->max_share);
    t->max_delta = larger(t->max_delta, by->max_delta);
    t->max_channel = t->max_channel > by->max_channel ? t->max_channel : by->max_channel;
    t->antialias = t->antialias || by->antialias;
    if (by->flip)
        t->pixels_per_degree = by->pixels_per_degree;
    t->flip = t->flip || by->flip;
    t->max_flip = larger(t->max_flip, by->max_flip);
}

bool tolerance_has_idle_resolution(const image_tolerance *t)
{
    const bool given = t->pixels_per_degree < FLIP_PIXELS_PER_DEGREE || t->pixels_per_degree > FLIP_PIXELS_PER_DEGREE;
    return given && !t->flip;
}
