/* SPDX-License-Identifier: MIT */
/* test_draw_difference.c - the picture of a difference: its colours, and writing it row by row. */
#include "fixture.h"
#include "images.h"
#include "temp_folder.h"
#include "image_compare.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 300, HEIGHT = 11 }; /* longer than the spans of the code under test, and no multiple of them */

typedef enum look { GREY, GLOWING, BLUE, VIOLET } look;

static look look_of(image_color c)
{
    if (c.r == c.g && c.g == c.b)
        return GREY;
    if (c.b > c.r && c.g > c.r)
        return BLUE;
    return c.b > c.g ? VIOLET : GLOWING;
}

/* As WCAG has it. */
static double luminance(image_color c)
{
    const double samples[3] = {c.r / 255.0, c.g / 255.0, c.b / 255.0};
    static const double weights[3] = {0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += weights[i] * (samples[i] * samples[i]); /* a gamma of 2 will do */
    return sum;
}

static image solid(int width, int height, uint8_t level)
{
    image made;
    assert_true(image_create(&made, width, height, 3));
    memset(made.pixels, level, (size_t)width * (size_t)height * 3);
    return made;
}

/* Noise where every third pixel of b is off by a little or by much. */
static void make_noise(image *a, image *b)
{
    uint64_t state = 5;
    *a = solid(WIDTH, HEIGHT, 0);
    *b = solid(WIDTH, HEIGHT, 0);
    for (int n = 0; n < WIDTH * HEIGHT * 3; n++)
        a->pixels[n] = (uint8_t)(random_below(&state, 8) * 31);
    memcpy(b->pixels, a->pixels, WIDTH * HEIGHT * 3);
    for (int n = 0; n < WIDTH * HEIGHT; n += 3)
        b->pixels[3 * n + n % 3] ^= (uint8_t)(random_below(&state, 2) ? 1 : 255);
}

/* Pixels of each look. */
typedef struct looks {
    uint64_t count[4];
} looks;

static looks count_looks(const image *a, const image *b, const image_tolerance *tolerance)
{
    const image_palette palette = image_make_difference_palette();
    const int width = a->width > b->width ? a->width : b->width, height = a->height > b->height ? a->height : b->height;
    looks found = {{0}};
    uint8_t *row = malloc((size_t)width);
    assert_non_null(row);
    for (int y = 0; y < height; y++) {
        image_draw_difference_row(a, b, tolerance, y, row);
        for (int x = 0; x < width; x++)
            found.count[look_of(palette.colors[row[x]])]++;
    }
    free(row);
    return found;
}

static void counted_pixels_are_hot_and_forgiven_pixels_are_blue(void **state)
{
    (void)state;
    static const image_rectangle ignored = {100, 2, 90, 5};
    static uint8_t mask[WIDTH * HEIGHT];
    static const image_tolerance tolerances[] = {
        {.max_pixels = 0},
        {.max_pixels = 9},
        {.max_delta = 0.02},
        {.antialias = true},
        {.ignored = &ignored, .ignored_count = 1},
        {.ignored_mask = mask},
        {.max_delta = 0.02, .antialias = true, .ignored = &ignored, .ignored_count = 1},
    };
    image a, b;
    make_noise(&a, &b);
    for (size_t n = 0; n < sizeof mask; n++)
        mask[n] = n % 2 == 0;
    for (size_t i = 0; i < sizeof tolerances / sizeof tolerances[0]; i++) {
        const image_difference d = image_compare_within(&a, &b, &tolerances[i]);
        const looks found = count_looks(&a, &b, &tolerances[i]);
        assert_true(d.counted.pixels > 0);
        assert_int_equal(found.count[GLOWING], d.counted.pixels);
        assert_int_equal(found.count[BLUE], d.close + d.antialiased + d.ignored);
        assert_int_equal(found.count[VIOLET], 0);
    }
    image_release(&a);
    image_release(&b);
}

static image_color drawn_pixel(const image *a, const image *b)
{
    static const image_tolerance exact = {.max_pixels = 0};
    uint8_t row[1];
    image_draw_difference_row(a, b, &exact, 0, row);
    return image_make_difference_palette().colors[row[0]];
}

/* One level of any channel on any ground is seen at once: much brighter than the lightest grey there can be. */
static void one_level_stands_out_from_every_grey(void **state)
{
    (void)state;
    const image_palette palette = image_make_difference_palette();
    for (int level = 0; level < 255; level += 17) {
        for (int channel = 0; channel < 3; channel++) {
            image a = solid(1, 1, (uint8_t)level), b = solid(1, 1, (uint8_t)level);
            b.pixels[channel]++;
            const image_color drawn = drawn_pixel(&a, &b);
            assert_int_equal(look_of(drawn), GLOWING);
            for (int i = 0; i < palette.count; i++)
                if (look_of(palette.colors[i]) == GREY)
                    assert_true(luminance(drawn) + 0.05 >= 1.8 * (luminance(palette.colors[i]) + 0.05));
            image_release(&a);
            image_release(&b);
        }
    }
}

static void larger_differences_are_brighter(void **state)
{
    (void)state;
    image a = solid(1, 1, 0), b = solid(1, 1, 0);
    double before = 0;
    for (int level = 1; level < 256; level += 6) {
        memset(b.pixels, level, 3);
        const double now = luminance(drawn_pixel(&a, &b));
        assert_true(now > before);
        before = now;
    }
    image_release(&a);
    image_release(&b);
}

static void one_level_of_sixteen_bits_is_visible(void **state)
{
    (void)state;
    image a = solid(1, 1, 40), b = solid(1, 1, 40);
    uint16_t samples[3] = {40 * 257, 40 * 257 + 1, 40 * 257};
    free(b.pixels);
    b.pixels = malloc(sizeof samples);
    assert_non_null(b.pixels);
    memcpy(b.pixels, samples, sizeof samples);
    b.wide = true;
    assert_int_equal(look_of(drawn_pixel(&a, &b)), GLOWING);
    image_release(&a);
    image_release(&b);
}

/* Of unlike sizes all is drawn, and nothing is forgiven. */
static void pixels_of_only_one_image_are_violet(void **state)
{
    (void)state;
    static const image_rectangle all = {0, 0, 1000, 1000};
    const image_tolerance tolerance = {.max_delta = 1, .ignored = &all, .ignored_count = 1};
    image a = solid(WIDTH, 4, 9), b = solid(WIDTH - 20, 9, 9);
    b.pixels[3 * (WIDTH - 20) + 1] = 8;
    const looks found = count_looks(&a, &b, &tolerance), swapped = count_looks(&b, &a, &tolerance);
    assert_int_equal(found.count[GLOWING], 1);
    assert_int_equal(found.count[BLUE], 0);
    assert_int_equal(found.count[GREY], (WIDTH - 20) * 4 - 1);
    assert_int_equal(found.count[VIOLET], WIDTH * 9 - (WIDTH - 20) * 4);
    assert_memory_equal(&found, &swapped, sizeof found);
    image_release(&a);
    image_release(&b);
}

/* ---- Pictures that are made while they are written ----------------------------------------------------------- */

static uint8_t sample_at(int y, int n)
{
    return (uint8_t)(y * 7 + n * 3);
}

static const uint8_t *make_row(int y, void *context)
{
    uint8_t *row = context;
    for (int n = 0; n < WIDTH * 3; n++)
        row[n] = sample_at(y, n);
    return row;
}

static void rows_are_written_while_they_are_produced(void **state)
{
    const image_palette palette = image_make_difference_palette();
    uint8_t row[WIDTH * 3];
    for (int indexed = 0; indexed < 2; indexed++) {
        const char *path = temp_file(*state, indexed ? "indexed.png" : "rgb.png");
        const image_rows rows = {WIDTH, HEIGHT, indexed ? &palette : NULL, make_row, row};
        octreel_error error = {""};
        assert_true(image_write_png_rows(&rows, path, &error));
        image back = assert_read(path);
        assert_int_equal(back.channels, indexed ? 1 : 3);
        for (int n = 0; n < WIDTH * HEIGHT * back.channels; n++)
            assert_int_equal(back.pixels[n], sample_at(n / (WIDTH * back.channels), n % (WIDTH * back.channels)));
        image_release(&back);
    }
}

static void failed_write_of_rows_reports_why_and_leaves_no_file(void **state)
{
    uint8_t row[WIDTH * 3];
    const image_rows rows = {WIDTH, HEIGHT, NULL, make_row, row};
    octreel_error error = {""};
    const char *path = temp_file(*state, "missing/rgb.png");
    assert_false(image_write_png_rows(&rows, path, &error));
    assert_sentence(&error, path, "No such file");
    assert_int_equal(temp_folder_count(*state), 0);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, temp_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counted_pixels_are_hot_and_forgiven_pixels_are_blue),
        cmocka_unit_test(one_level_stands_out_from_every_grey),
        cmocka_unit_test(larger_differences_are_brighter),
        cmocka_unit_test(one_level_of_sixteen_bits_is_visible),
        cmocka_unit_test(pixels_of_only_one_image_are_violet),
        WITH_FOLDER(rows_are_written_while_they_are_produced),
        WITH_FOLDER(failed_write_of_rows_reports_why_and_leaves_no_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
