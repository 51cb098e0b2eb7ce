/* compare.c - the difference of two images: counting, judging, drawing. */
#include "image.h"

#include <stdlib.h>
#include <string.h>

/* Colours are compared in spans of this many pixels, small enough for the stack and the first cache. */
#define SPAN 256

static const image_color UNLIKE_COLOR = {255, 0, 0};

/* Do equal bytes mean equal colours? The whole tables count: they are always there. */
static bool stored_alike(const image *a, const image *b)
{
    if (a->channels != b->channels)
        return false;
    return a->channels == 3 || memcmp(a->palette.colors, b->palette.colors, sizeof a->palette.colors) == 0;
}

/* The r, g, b bytes of the `count` pixels from the n-th on: in place, or looked up into `room`. */
static const uint8_t *span_colors(const image *image, size_t n, int count, uint8_t room[3 * SPAN])
{
    if (image->channels == 3)
        return image->pixels + 3 * n;
    for (int i = 0; i < count; i++)
        memcpy(room + 3 * i, &image->palette.colors[image->pixels[n + (size_t)i]], 3);
    return room;
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

static int largest_delta(const uint8_t *a, const uint8_t *b)
{
    int delta = 0;
    for (int i = 0; i < 3; i++)
        delta = larger(delta, abs(a[i] - b[i]));
    return delta;
}

static void count_pixel(image_difference *difference, int x, int y, int delta)
{
    if (difference->pixels == 0) {
        difference->first_x = difference->min_x = difference->max_x = x;
        difference->first_y = difference->min_y = difference->max_y = y;
    }
    difference->pixels++;
    difference->largest_delta = larger(difference->largest_delta, delta);
    difference->min_x = smaller(difference->min_x, x);
    difference->max_x = larger(difference->max_x, x);
    difference->max_y = y; /* rows come in order */
}

static void count_row(image_difference *difference, const image *a, const image *b, int y)
{
    uint8_t room_a[3 * SPAN], room_b[3 * SPAN];
    for (int x = 0; x < a->width; x += SPAN) {
        int count = smaller(SPAN, a->width - x);
        size_t n = (size_t)y * (size_t)a->width + (size_t)x;
        const uint8_t *colors_a = span_colors(a, n, count, room_a);
        const uint8_t *colors_b = span_colors(b, n, count, room_b);
        if (memcmp(colors_a, colors_b, 3 * (size_t)count) == 0)
            continue;
        for (int i = 0; i < count; i++) {
            int delta = largest_delta(colors_a + 3 * i, colors_b + 3 * i);
            if (delta != 0)
                count_pixel(difference, x + i, y, delta);
        }
    }
}

image_difference image_compare(const image *a, const image *b)
{
    image_difference difference = {.first_x = -1, .first_y = -1, .min_x = -1, .min_y = -1, .max_x = -1, .max_y = -1};
    difference.same_size = a->width == b->width && a->height == b->height;
    if (!difference.same_size)
        return difference;
    bool alike = stored_alike(a, b);
    size_t row_size = (size_t)a->width * (size_t)a->channels;
    for (int y = 0; y < a->height; y++) {
        size_t row = (size_t)y * row_size;
        if (!alike || memcmp(a->pixels + row, b->pixels + row, row_size) != 0)
            count_row(&difference, a, b, y);
    }
    return difference;
}

bool image_same(const image_difference *difference)
{
    return difference->same_size && difference->pixels == 0;
}

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
