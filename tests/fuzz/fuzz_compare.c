/* SPDX-License-Identifier: MIT */
/* fuzz_compare.c - libFuzzer entry of octreel/compare.h. Ten bytes choose the pixels and the tolerance; the rest is a
 * reference file as in png_input.h, which may be a baseline. Whatever the file is, the result is consistent; pixels and
 * a file give the same result as the pixels of this file; and a file is equal to its own pixels. Build with clang
 * -fsanitize=fuzzer,address,undefined. */
#include "octreel/compare.h"
#include "support/png_input.h"
#include "png_read.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { CHOICES = 10, MOST_PIXELS = 1 << 14, GAP = 3 };

static void check(bool holds)
{
    if (!holds)
        abort();
}

/* ---- What must hold of every result --------------------------------------------------------------------------- */

static void check_bounds(const octreel_comparison *c)
{
    if (c->different == 0) {
        check(c->worst_x == -1 && c->min_x == -1 && c->max_y == -1 && c->worst_delta == 0);
        return;
    }
    check(0 <= c->min_x && c->min_x <= c->worst_x && c->worst_x <= c->max_x && c->max_x < c->width);
    check(0 <= c->min_y && c->min_y <= c->worst_y && c->worst_y <= c->max_y && c->max_y < c->height);
    check(c->worst_delta > 0 && c->worst_delta <= 1);
    check(c->largest_channel > 0 && c->largest_channel <= c->channel_range);
}

static void check_result(octreel_verdict verdict, const octreel_comparison *c, const octreel_compare_def *def)
{
    check(verdict == c->verdict && strlen(c->sentence) > 0);
    check(c->counted + c->close + c->antialiased == c->different);
    check_bounds(c);
    if (verdict == OCTREEL_VERDICT_TROUBLE)
        check(c->different == 0 && c->width == 0 && c->reference_width == 0);
    else
        check(c->width > 0 && c->reference_height > 0);
    if (verdict == OCTREEL_VERDICT_SAME)
        check(c->counted <= def->max_pixels && c->width == c->reference_width && c->height == c->reference_height);
}

static bool is_same_result(const octreel_comparison *a, const octreel_comparison *b)
{
    return a->verdict == b->verdict && a->different == b->different && a->counted == b->counted &&
           a->close == b->close && a->antialiased == b->antialiased && a->ignored == b->ignored &&
           a->worst_delta == b->worst_delta && a->worst_x == b->worst_x && a->worst_y == b->worst_y &&
           a->largest_channel == b->largest_channel && a->min_x == b->min_x && a->max_x == b->max_x &&
           a->min_y == b->min_y && a->max_y == b->max_y;
}

static octreel_comparison compare(const octreel_pixels *actual, const char *path, const octreel_compare_def *def)
{
    octreel_comparison found;
    const octreel_verdict verdict = octreel_compare_pixels_to_file(actual, path, def, &found);
    check_result(verdict, &found, def);
    return found;
}

/* ---- Pixels from input ---------------------------------------------------------------------------------------- */

/* Fill the pixels by repeating the input. The rows have a gap behind them. */
static octreel_pixels make_pixels(const uint8_t *data, size_t size, int width, int height, uint8_t room[])
{
    static const size_t pixel_sizes[OCTREEL_PIXEL_FORMATS] = {1, 3, 4, 4, 6, 8};
    const octreel_pixel_format format = (octreel_pixel_format)(data[0] % OCTREEL_PIXEL_FORMATS);
    octreel_pixels pixels = octreel_make_pixels(room, width, height, format);
    const size_t row = (size_t)width * pixel_sizes[format];
    pixels.bottom_up = data[1] & 1;
    pixels.stride = data[1] & 2 ? row + GAP : 0;
    const size_t bytes = (pixels.stride ? pixels.stride : row) * (size_t)height;
    for (size_t i = 0; i < bytes; i++)
        room[i] = data[i % size];
    return pixels;
}

static octreel_compare_def make_definition(const uint8_t *data, octreel_rectangle *ignored)
{
    octreel_compare_def def = octreel_compare_def_default();
    *ignored = (octreel_rectangle){data[6] % 16, data[7] % 16, 1 + data[8] % 16, 1 + data[9] % 16};
    def.antialias = data[1] & 4;
    def.ignored_count = data[1] & 8 ? 1 : 0;
    def.ignored = ignored;
    def.max_delta = data[4] % 4 / 16.0;
    def.max_pixels = data[5];
    def.background = data[1] & 16 ? 0x123456 : 0xffffff;
    return def;
}

/* The file is equal to its own pixels, and `actual` differs from both in the same way. */
static void check_own_pixels(const octreel_pixels *actual, const char *path, const octreel_compare_def *def)
{
    const uint32_t ground = def->background;
    image own;
    octreel_error error;
    if (!image_read_png_over(path, (image_color){(uint8_t)(ground >> 16), (uint8_t)(ground >> 8), (uint8_t)ground},
                             &own, &error))
        abort();
    const size_t count = (size_t)own.width * (size_t)own.height;
    uint8_t *rgb = malloc(6 * count);
    check(rgb != NULL);
    for (size_t n = 0; n < count; n++) {
        const image_color color = image_color_at(&own, (int)(n % (size_t)own.width), (int)(n / (size_t)own.width));
        memcpy(rgb + 3 * n, &color, 3);
    }
    const octreel_pixels pixels = octreel_make_pixels(own.wide ? own.pixels : rgb, own.width, own.height,
                                                      own.wide ? OCTREEL_RGB16 : OCTREEL_RGB8);
    octreel_comparison found = compare(&pixels, path, def);
    check(found.verdict == OCTREEL_VERDICT_SAME && found.different == 0 && found.ignored == 0);
    const octreel_comparison to_file = compare(actual, path, def);
    octreel_compare_pixels(actual, &pixels, def, &found);
    check(is_same_result(&to_file, &found));
    free(rgb);
    image_release(&own);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static png_input file;
    static uint8_t room[8 * MOST_PIXELS + GAP * 16384];
    if (size < CHOICES + 2 || size > PNG_INPUT_MOST / 2)
        return 0;
    octreel_rectangle ignored;
    octreel_compare_def def = make_definition(data, &ignored);
    png_input_make(&file, data + CHOICES, size - CHOICES);
    const char *path = png_input_save(&file);
    octreel_pixels actual = make_pixels(data, size, 1 + data[2] % 32, 1 + data[3] % 32, room);
    octreel_comparison found = compare(&actual, path, &def);
    if (found.verdict == OCTREEL_VERDICT_TROUBLE) { /* as a baseline does with a tolerance */
        def = octreel_compare_def_default();
        found = compare(&actual, path, &def);
    }
    const int width = found.reference_width, height = found.reference_height;
    check_result(octreel_compare_files(path, path, &def, &found), &found, &def);
    const bool is_png = file.size > 4 && memcmp(file.bytes, "\x89PNG", 4) == 0;
    if (width == 0 || width * height > MOST_PIXELS || !is_png)
        return 0;
    actual = make_pixels(data, size, width, height, room);
    check_own_pixels(&actual, path, &def);
    return 0;
}
