/* SPDX-License-Identifier: MIT */
/* test_flip.c - FLIP against the formulae of the paper in doubles, at borders of images and strips, and bit for bit. */
#include "fixture.h"
#include "images.h"
#include "naive_flip.h"
#include "flip.h"
#include "octree/digest.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const image_tolerance standard = {.pixels_per_degree = FLIP_PIXELS_PER_DEGREE};

static image empty_image(int width, int height)
{
    image made;
    assert_true(image_create(&made, width, height, 3));
    return made;
}

static image solid(int width, int height, image_color color)
{
    image made = empty_image(width, height);
    for (int i = 0; i < width * height; i++)
        memcpy(made.pixels + 3 * i, (uint8_t[]){color.r, color.g, color.b}, 3);
    return made;
}

static uint8_t *pixel(const image *of, int x, int y)
{
    return of->pixels + 3 * (y * of->width + x);
}

/* A gradient with coloured squares on it. */
static image draw_squares(int width, int height, uint64_t seed)
{
    image made = empty_image(width, height);
    for (int i = 0; i < 3 * width * height; i++)
        made.pixels[i] = (uint8_t)(40 + (i / 3 % width * 3 + i / 3 / width * 2 + i % 3 * 50) % 160);
    for (int i = 0; i < 1 + width * height / 300; i++) {
        const int left = (int)random_below(&seed, (uint64_t)width), top = (int)random_below(&seed, (uint64_t)height);
        const int side = 1 + (int)random_below(&seed, 12);
        const uint8_t color[3] = {(uint8_t)random_below(&seed, 256), (uint8_t)random_below(&seed, 256),
                                  (uint8_t)random_below(&seed, 256)};
        for (int y = top; y < top + side && y < height; y++)
            for (int x = left; x < left + side && x < width; x++)
                memcpy(pixel(&made, x, y), color, 3);
    }
    return made;
}

/* A copy that is off by up to `most` levels. */
static image add_noise(const image *from, int most, uint64_t seed)
{
    image made = empty_image(from->width, from->height);
    for (int i = 0; i < 3 * from->width * from->height; i++) {
        const int value = from->pixels[i] + (int)random_below(&seed, (uint64_t)(2 * most + 1)) - most;
        made.pixels[i] = (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
    }
    return made;
}

static uint8_t *measure(const image *a, const image *b, const image_tolerance *tolerance, image_flip *flip)
{
    uint8_t *map = malloc((size_t)a->width * (size_t)a->height);
    assert_non_null(map);
    assert_true(image_measure_flip(a, b, tolerance, map, flip));
    return map;
}

/* ---- Values ------------------------------------------------------------------------------------------------------ */

/* Largest errors of the mean. Flat areas are the worst case for floats: the sum of a detector's weights is not quite 0,
 * and the value depends on the square root of the strength of a feature. */
#define OF_DETAIL 3e-6
#define OF_FLAT 5e-5

static void assert_follows_formulae(const image *a, const image *b, double pixels_per_degree, double error)
{
    const image_tolerance tolerance = {.pixels_per_degree = pixels_per_degree};
    const int count = a->width * a->height;
    double sum = 0, worst = 0, *expected = naive_flip(a, b, pixels_per_degree);
    image_flip flip;
    uint8_t *map = measure(a, b, &tolerance, &flip);
    for (int i = 0; i < count; i++) {
        assert_true(fabs(255 * expected[i] - map[i]) < 0.5 + 255 * 1e-3);
        worst = fmax(worst, expected[i]);
        sum += expected[i];
    }
    assert_true(fabs(flip.mean - sum / count) <= error);
    assert_true(fabs(flip.worst - worst) <= OF_FLAT);
    assert_true(fabs(flip.worst - expected[flip.worst_y * a->width + flip.worst_x]) <= OF_FLAT);
    free(expected);
    free(map);
}

static void values_follow_the_formulae(void **state)
{
    (void)state;
    static const double resolutions[] = {FLIP_PIXELS_PER_DEGREE, 30, 5, FLIP_LEAST_PIXELS_PER_DEGREE, 120};
    for (size_t i = 0; i < sizeof resolutions / sizeof resolutions[0]; i++) {
        image a = draw_squares(70, 40, 1 + i), others[] = {draw_squares(70, 40, 9 + i), add_noise(&a, 3, i)};
        for (int j = 0; j < 2; j++) {
            assert_follows_formulae(&a, &others[j], resolutions[i], OF_DETAIL);
            image_release(&others[j]);
        }
        image_release(&a);
    }
}

static void small_images_and_borders_of_strips_follow_the_formulae(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1},   {1, 2},   {1, 60},  {60, 1},  {2, 2}, {9, 11},
                                   {255, 3}, {256, 3}, {257, 3}, {530, 2}, {3, 50}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        image a = draw_squares(sizes[i][0], sizes[i][1], 3 + i), b = draw_squares(sizes[i][0], sizes[i][1], 77 + i);
        assert_follows_formulae(&a, &b, FLIP_PIXELS_PER_DEGREE, sizes[i][0] == 1 ? OF_FLAT : OF_DETAIL);
        image_release(&a);
        image_release(&b);
    }
}

static void the_highest_resolution_follows_the_formulae(void **state)
{
    (void)state;
    image a = draw_squares(12, 9, 4), b = draw_squares(12, 9, 5);
    assert_follows_formulae(&a, &b, FLIP_MOST_PIXELS_PER_DEGREE, OF_DETAIL);
    image_release(&a);
    image_release(&b);
}

static void flat_colours_follow_the_formulae(void **state)
{
    (void)state;
    uint64_t random = 12;
    for (int i = 0; i < 40; i++) {
        image pair[2];
        for (int j = 0; j < 2; j++)
            pair[j] = solid(3, 2,
                            (image_color){(uint8_t)random_below(&random, 256), (uint8_t)random_below(&random, 256),
                                          (uint8_t)random_below(&random, 256)});
        assert_follows_formulae(&pair[0], &pair[1], FLIP_PIXELS_PER_DEGREE, OF_FLAT);
        image_release(&pair[0]);
        image_release(&pair[1]);
    }
}

/* The constant MOST of flip_color.c. */
static void largest_difference_is_that_of_green_and_blue(void **state)
{
    (void)state;
    assert_true(fabs(naive_flip_largest_difference() - 41.2760984) < 1e-6);
    for (int i = 0; i < 64; i++) {
        image a = solid(1, 1, (image_color){i & 1 ? 255 : 0, i & 2 ? 255 : 0, i & 4 ? 255 : 0});
        image b = solid(1, 1, (image_color){i & 8 ? 255 : 0, i & 16 ? 255 : 0, i & 32 ? 255 : 0});
        const bool green_blue = (i & 7) * (i >> 3) == 2 * 4 && (i & 7) != 1 && (i >> 3) != 1;
        image_flip flip;
        free(measure(&a, &b, &standard, &flip));
        assert_true(green_blue ? flip.mean > 0.99999 && flip.mean <= 1 : flip.mean < 0.9999);
        image_release(&a);
        image_release(&b);
    }
}

/* ---- Laws -------------------------------------------------------------------------------------------------------- */

static void equal_images_have_the_value_0(void **state)
{
    (void)state;
    image_twins twins = make_twins(40, 30);
    image a = draw_squares(300, 40, 8);
    image_flip flip;
    free(measure(&a, &a, &standard, &flip));
    assert_true(flip.mean == 0 && flip.worst == 0 && flip.worst_x == -1 && flip.worst_y == -1);
    free(measure(&twins.indexed, &twins.rgb, &standard, &flip));
    assert_true(flip.mean == 0 && flip.worst == 0);
    release_twins(&twins);
    image_release(&a);
}

static void swapped_images_have_the_same_values(void **state)
{
    (void)state;
    image a = draw_squares(280, 50, 2), b = add_noise(&a, 20, 3);
    image_flip one, other;
    uint8_t *map = measure(&a, &b, &standard, &one), *swapped = measure(&b, &a, &standard, &other);
    assert_true(one.mean == other.mean && one.worst == other.worst);
    assert_int_equal(one.worst_x, other.worst_x);
    assert_memory_equal(map, swapped, 280 * 50);
    free(map);
    free(swapped);
    image_release(&a);
    image_release(&b);
}

/* Rows without a difference in their neighbourhood are skipped: the values near it must not depend on that. */
static void a_value_is_0_where_the_filters_reach_no_difference(void **state)
{
    (void)state;
    image a = draw_squares(40, 90, 6), b = add_noise(&a, 0, 0);
    image_flip flip;
    memset(pixel(&b, 20, 45), 255, 3);
    uint8_t *map = measure(&a, &b, &standard, &flip);
    assert_follows_formulae(&a, &b, FLIP_PIXELS_PER_DEGREE, OF_DETAIL);
    for (int i = 0; i < 40 * 90; i++)
        if (abs(i % 40 - 20) > 10 || abs(i / 40 - 45) > 10)
            assert_int_equal(map[i], 0);
    assert_int_equal(flip.worst_x, 20);
    assert_int_equal(flip.worst_y, 45);
    free(map);
    image_release(&a);
    image_release(&b);
}

static void ignored_pixels_do_not_count(void **state)
{
    (void)state;
    static const image_rectangle left = {0, 0, 30, 100};
    uint8_t mask[60 * 50] = {0};
    image a = draw_squares(60, 50, 6), b = add_noise(&a, 0, 0);
    image_flip whole, part, half;
    for (int y = 0; y < 50; y++)
        memset(pixel(&b, 10, y), 255, 15);
    for (int i = 0; i < 60 * 50; i++)
        mask[i] = i % 60 < 30;
    free(measure(&a, &b, &standard, &whole));
    assert_true(whole.mean > 0.1);
    image_tolerance ignoring = {.pixels_per_degree = FLIP_PIXELS_PER_DEGREE, .ignored = &left, .ignored_count = 1};
    free(measure(&a, &b, &ignoring, &part));
    assert_true(part.mean == 0);
    pixel(&b, 50, 20)[1] ^= 128;
    free(measure(&a, &b, &ignoring, &part));
    ignoring = (image_tolerance){.pixels_per_degree = FLIP_PIXELS_PER_DEGREE, .ignored_mask = mask};
    free(measure(&a, &b, &ignoring, &half));
    assert_true(part.mean > 0 && part.mean == half.mean && part.worst_x == 50);
    image_release(&a);
    image_release(&b);
}

static void samples_of_16_bits_have_the_values_of_8_bits(void **state)
{
    (void)state;
    image a = draw_squares(50, 20, 6), b = add_noise(&a, 9, 1), wide = empty_image(50, 20);
    image_flip narrow, mixed;
    free(wide.pixels);
    wide.wide = true;
    wide.pixels = malloc(50 * 20 * 6);
    assert_non_null(wide.pixels);
    for (int i = 0; i < 50 * 20 * 3; i++)
        memcpy(wide.pixels + 2 * i, &(uint16_t){(uint16_t)(257 * a.pixels[i])}, 2);
    free(measure(&a, &b, &standard, &narrow));
    free(measure(&wide, &b, &standard, &mixed));
    assert_true(narrow.mean == mixed.mean && narrow.worst == mixed.worst);
    image_release(&a);
    image_release(&b);
    image_release(&wide);
}

static void tolerance_forgives_a_mean_up_to_the_maximum(void **state)
{
    (void)state;
    const image_difference d = {.same_size = true, .counted.pixels = 9, .has_flip = true, .flip.mean = 0.25};
    image_difference unmeasured = d, other_size = d;
    unmeasured.has_flip = false;
    other_size.same_size = false;
    assert_true(image_is_within_tolerance(&d, &(image_tolerance){.flip = true, .max_flip = 0.25}));
    assert_false(image_is_within_tolerance(&d, &(image_tolerance){.flip = true, .max_flip = 0.2499}));
    assert_false(image_is_within_tolerance(&d, &(image_tolerance){.max_flip = 1}));
    assert_false(image_is_within_tolerance(&unmeasured, &(image_tolerance){.flip = true, .max_flip = 1}));
    assert_false(image_is_within_tolerance(&other_size, &(image_tolerance){.flip = true, .max_flip = 1}));
}

/* ---- Bits -------------------------------------------------------------------------------------------------------- */

#define PINNED_MEAN 0x1.4a1dab2d9c378p-4
#define PINNED_WORST 0x1.34ec5p-1
#define PINNED_DIGEST UINT64_C(0x791f4ded3a9e80ed)

/* The same on every machine and with every compiler: the mean, the largest value and the bytes of the map. */
static void bits_are_the_same_everywhere(void **state)
{
    (void)state;
    image a = draw_squares(300, 120, 1), b = add_noise(&a, 12, 2);
    image_flip flip;
    memset(pixel(&b, 0, 60), 0, 900);
    uint8_t *map = measure(&a, &b, &standard, &flip);
    const uint64_t digest = octree_digest_bytes(OCTREE_DIGEST_START, map, 300 * 120);
    if (flip.mean != PINNED_MEAN || flip.worst != PINNED_WORST || digest != PINNED_DIGEST)
        fail_msg("mean %a, worst %a, digest %016" PRIx64, flip.mean, flip.worst, digest);
    free(map);
    image_release(&a);
    image_release(&b);
}

static void magma_gets_lighter_from_black_to_pale_yellow(void **state)
{
    (void)state;
    const image_palette palette = image_make_magma_palette();
    double before = -1;
    assert_int_equal(palette.count, 256);
    assert_true(palette.colors[0].r == 0 && palette.colors[0].g == 0 && palette.colors[0].b == 4);
    assert_true(palette.colors[255].r == 252 && palette.colors[255].g == 253 && palette.colors[255].b == 191);
    for (int i = 0; i < 256; i++) {
        const image_color c = palette.colors[i];
        const double luma = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
        assert_true(luma > before - 1); /* rounding to 8 bits may darken a step */
        before = luma;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_follow_the_formulae),
        cmocka_unit_test(small_images_and_borders_of_strips_follow_the_formulae),
        cmocka_unit_test(the_highest_resolution_follows_the_formulae),
        cmocka_unit_test(flat_colours_follow_the_formulae),
        cmocka_unit_test(largest_difference_is_that_of_green_and_blue),
        cmocka_unit_test(equal_images_have_the_value_0),
        cmocka_unit_test(swapped_images_have_the_same_values),
        cmocka_unit_test(a_value_is_0_where_the_filters_reach_no_difference),
        cmocka_unit_test(ignored_pixels_do_not_count),
        cmocka_unit_test(samples_of_16_bits_have_the_values_of_8_bits),
        cmocka_unit_test(tolerance_forgives_a_mean_up_to_the_maximum),
        cmocka_unit_test(bits_are_the_same_everywhere),
        cmocka_unit_test(magma_gets_lighter_from_black_to_pale_yellow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
