/* SPDX-License-Identifier: MIT */
/* test_compare.c - counting and judging the difference of two images, against an oracle that compares pixel by pixel.
 */
#include "images.h"
#include "naive_compare.h"
#include "image_digest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A small generator, so that pictures are the same everywhere. */
static unsigned next_random(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (unsigned)(*state >> 33);
}

/* Ways of storing a picture of few colours. */
typedef enum storage { INDEXED, RGB, WIDE, STORAGES } storage;

static image empty_image(int width, int height, storage kind)
{
    image made;
    assert_true(image_create(&made, width, height, kind == INDEXED ? 1 : 3));
    if (kind == WIDE) {
        free(made.pixels);
        made.wide = true;
        made.pixels = calloc((size_t)width * (size_t)height, 6);
        assert_non_null(made.pixels);
    }
    return made;
}

static void put_wide(image *to, int n, const unsigned samples[3])
{
    for (int i = 0; i < 3; i++) {
        const uint16_t sample = (uint16_t)samples[i];
        memcpy(to->pixels + 2 * (3 * n + i), &sample, 2);
    }
}

/* Bands of a few colours with noise in them: flat patches, edges and single pixels. */
static image make_picture(int width, int height, storage kind, uint64_t seed)
{
    uint64_t state = seed;
    image made = empty_image(width, height, kind);
    unsigned colors[6][3];
    for (int i = 0; i < 18; i++)
        colors[i / 3][i % 3] = next_random(&state) % (kind == WIDE ? 65536 : 256);
    for (int i = 0; kind == INDEXED && i < 6; i++)
        made.palette.colors[i] = (image_color){(uint8_t)colors[i][0], (uint8_t)colors[i][1], (uint8_t)colors[i][2]};
    made.palette.count = kind == INDEXED ? 6 : 0;
    for (int n = 0; n < width * height; n++) {
        const int x = n % width, y = n / width;
        const unsigned which = next_random(&state) % 8 == 0 ? next_random(&state) % 6 : (unsigned)(x / 4 + y / 3) % 6;
        if (kind == INDEXED)
            made.pixels[n] = (uint8_t)which;
        else if (kind == WIDE)
            put_wide(&made, n, colors[which]);
        else
            for (int i = 0; i < 3; i++)
                made.pixels[3 * n + i] = (uint8_t)colors[which][i];
    }
    return made;
}

static image copy_image(const image *from)
{
    image copy = *from;
    const size_t size = (size_t)from->width * (size_t)from->height * image_pixel_size(from);
    copy.pixels = malloc(size);
    assert_non_null(copy.pixels);
    memcpy(copy.pixels, from->pixels, size);
    return copy;
}

static void spoil(image *picture, uint64_t *state, int times)
{
    const unsigned size = (unsigned)((size_t)picture->width * (size_t)picture->height * image_pixel_size(picture));
    for (int i = 0; i < times; i++) {
        uint8_t *at = picture->pixels + next_random(state) % size;
        *at = picture->channels == 1 ? (uint8_t)(next_random(state) % 6) : (uint8_t)next_random(state);
    }
}

static void counts_equal_the_naive_comparison(void **state)
{
    (void)state;
    static const image_rectangle ignored[] = {{3, 2, 5, 4}, {-4, -4, 6, 6}, {15, 10, 2147483647, 2147483647}};
    uint8_t mask[40 * 20];
    uint64_t random = 7;
    for (size_t i = 0; i < sizeof mask; i++)
        mask[i] = (uint8_t)(i % 7 < 2 ? i % 7 : 0);
    for (int i = 0; i < 1500; i++) {
        const int width = 1 + (int)(next_random(&random) % 40), height = 1 + (int)(next_random(&random) % 20);
        const image_tolerance tolerance = {.max_delta = i % 3 == 0 ? 0 : (next_random(&random) % 100) / 150.0,
                                           .max_channel = i % 4 == 1 ? i % 97 : 0,
                                           .antialias = i % 2 == 0,
                                           .ignored = ignored,
                                           .ignored_count = next_random(&random) % 4,
                                           .ignored_mask = next_random(&random) % 2 ? mask : NULL};
        image a = make_picture(width, height, (storage)(i % STORAGES), next_random(&random));
        image b = i % 5 == 0 ? make_picture(width, height, (storage)(i / 5 % STORAGES), next_random(&random))
                             : copy_image(&a);
        spoil(&b, &random, (int)(next_random(&random) % 30));
        const image_difference counted = image_compare_within(&a, &b, &tolerance);
        const image_difference expected = naive_compare(&a, &b, &tolerance);
        assert_same_difference(&counted, &expected);
        image_release(&a);
        image_release(&b);
    }
}

static void rows_longer_than_a_span_are_counted_whole(void **state)
{
    (void)state;
    static const image_tolerance exact = {.max_pixels = 0};
    uint64_t random = 3;
    for (int width = 120; width < 520; width += 67) {
        for (int kind = 0; kind < STORAGES; kind++) {
            image a = make_picture(width, 5, (storage)kind, 11);
            image b = copy_image(&a);
            spoil(&b, &random, 9);
            const image_difference counted = image_compare(&a, &b), expected = naive_compare(&a, &b, &exact);
            assert_same_difference(&counted, &expected);
            image_release(&a);
            image_release(&b);
        }
    }
}

static image flat_image(uint8_t r, uint8_t g, uint8_t b)
{
    image made = empty_image(1, 1, RGB);
    memcpy(made.pixels, (uint8_t[]){r, g, b}, 3);
    return made;
}

static double delta_of(const uint8_t a[3], const uint8_t b[3])
{
    image from = flat_image(a[0], a[1], a[2]), to = flat_image(b[0], b[1], b[2]);
    const image_difference difference = image_compare(&from, &to);
    image_release(&from);
    image_release(&to);
    return difference.unlike.worst_delta;
}

/* Figures of pixelmatch 7.2's own colorDelta(), divided by 35215 and rooted. */
static void color_distance_has_the_scale_of_pixelmatch(void **state)
{
    (void)state;
    static const struct {
        uint8_t a[3], b[3];
        double delta;
    } known[] = {
        {{0, 0, 0}, {255, 255, 255}, 0.965941861},    {{13, 17, 26}, {236, 240, 246}, 0.843432211},
        {{255, 64, 64}, {240, 228, 66}, 0.435747217}, {{0, 255, 0}, {0, 223, 0}, 0.085230516},
        {{10, 20, 30}, {10, 20, 31}, 0.001267021},    {{255, 0, 255}, {0, 255, 0}, 0.767340682},
        {{84, 98, 150}, {74, 110, 168}, 0.050002103},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        assert_true(fabs(delta_of(known[i].a, known[i].b) - known[i].delta) < 1e-6);
}

static void color_distance_is_at_most_1_and_0_only_for_equal_colours(void **state)
{
    (void)state;
    double most = 0;
    for (int corners = 1; corners < 64; corners++) {
        uint8_t a[3], b[3];
        for (int i = 0; i < 3; i++) {
            a[i] = corners >> i & 1 ? 255 : 0;
            b[i] = corners >> (i + 3) & 1 ? 255 : 0;
        }
        most = fmax(most, delta_of(a, b));
    }
    assert_true(most > 0.99 && most <= 1);
    for (int i = 0; i < 3; i++) {
        uint8_t a[3] = {100, 100, 100}, b[3] = {100, 100, 100};
        b[i]++;
        assert_true(delta_of(a, b) > 0);
    }
}

/* 32 levels of green are what odiff and pixelmatch forgive by default. */
static void a_palette_change_on_every_line_is_found(void **state)
{
    (void)state;
    image a = make_picture(640, 360, INDEXED, 5), b = copy_image(&a);
    uint64_t expected = 0;
    b.palette.colors[2].g = (uint8_t)(b.palette.colors[2].g + (b.palette.colors[2].g < 128 ? 32 : -32));
    for (int n = 0; n < 640 * 360; n++)
        expected += a.pixels[n] == 2;
    const image_difference difference = image_compare(&a, &b);
    assert_false(image_has_no_difference(&difference));
    assert_int_equal(difference.unlike.pixels, expected);
    assert_int_equal(difference.unlike.largest_channel, 32);
    assert_int_equal(difference.unlike.min_y, 0);
    assert_int_equal(difference.unlike.max_y, 359);
    assert_true(difference.unlike.worst_delta < 0.1);
    image_release(&a);
    image_release(&b);
}

static void a_difference_in_the_lowest_of_16_bits_is_found(void **state)
{
    (void)state;
    image a = make_picture(9, 9, WIDE, 8), b = copy_image(&a);
    uint16_t sample;
    memcpy(&sample, b.pixels + 6 * 40, 2);
    sample ^= 1;
    memcpy(b.pixels + 6 * 40, &sample, 2);
    const image_difference difference = image_compare(&a, &b);
    assert_int_equal(difference.unlike.pixels, 1);
    assert_int_equal(difference.unlike.largest_channel, 1);
    assert_int_equal(difference.channel_range, 65535);
    assert_true(difference.unlike.worst_delta > 0);
    for (int kind = 0; kind < IMAGE_DIGEST_KINDS; kind++)
        assert_true(image_digest_with((image_digest_kind)kind, &a) != image_digest_with((image_digest_kind)kind, &b));
    image_release(&a);
    image_release(&b);
}

static void image_equals_the_same_image_with_16_bits_a_sample(void **state)
{
    (void)state;
    image narrow = make_picture(31, 7, RGB, 4), wide = empty_image(31, 7, WIDE);
    for (int n = 0; n < 31 * 7; n++) {
        const uint8_t *at = narrow.pixels + 3 * n;
        put_wide(&wide, n, (unsigned[]){at[0] * 257u, at[1] * 257u, at[2] * 257u});
    }
    const image_difference difference = image_compare(&narrow, &wide);
    assert_true(image_has_no_difference(&difference));
    image_release(&narrow);
    image_release(&wide);
}

static void tolerance_forgives_only_what_it_names(void **state)
{
    (void)state;
    image a = make_picture(30, 30, RGB, 21), b = copy_image(&a);
    for (int i = 0; i < 5; i++)
        b.pixels[3 * (70 * i + 11)] ^= 1;
    for (uint64_t most = 0; most < 8; most++) {
        const image_tolerance tolerance = {.max_pixels = most};
        const image_difference difference = image_compare_within(&a, &b, &tolerance);
        assert_int_equal(difference.unlike.pixels, 5);
        assert_int_equal(image_is_within_tolerance(&difference, &tolerance), most >= 5);
        assert_false(image_has_no_difference(&difference));
    }
    image_release(&a);
    image_release(&b);
}

/* A slanted edge, white on black, drawn twice: hard, and with grey where it cuts pixels. */
static void an_antialiased_edge_is_forgiven_and_a_dot_is_not(void **state)
{
    (void)state;
    image hard = empty_image(40, 40, RGB), soft = empty_image(40, 40, RGB);
    for (int n = 0; n < 1600; n++) {
        const double covered = fmin(1, fmax(0, n % 40 - (10 + n / 40 * 0.4)));
        memset(hard.pixels + 3 * n, covered >= 0.5 ? 255 : 0, 3);
        memset(soft.pixels + 3 * n, (int)(255 * covered), 3);
    }
    const image_tolerance tolerance = {.antialias = true};
    image_difference difference = image_compare_within(&hard, &soft, &tolerance);
    assert_true(difference.unlike.pixels > 20);
    assert_true(image_is_within_tolerance(&difference, &tolerance));
    memset(soft.pixels + 3 * (20 * 40 + 35), 0, 3);
    difference = image_compare_within(&hard, &soft, &tolerance);
    assert_int_equal(difference.counted.pixels, 1);
    assert_true(difference.counted.worst_x == 35 && difference.counted.worst_y == 20);
    image_release(&hard);
    image_release(&soft);
}

static void no_tolerance_forgives_different_sizes(void **state)
{
    (void)state;
    image a = empty_image(4, 6, RGB), b = empty_image(6, 4, RGB);
    const image_tolerance all = {.max_pixels = UINT64_MAX, .max_delta = 1, .antialias = true};
    const image_difference difference = image_compare_within(&a, &b, &all);
    assert_false(difference.same_size);
    assert_false(image_has_no_difference(&difference));
    assert_false(image_is_within_tolerance(&difference, &all));
    assert_int_equal(difference.unlike.pixels, 0);
    image_release(&a);
    image_release(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts_equal_the_naive_comparison),
        cmocka_unit_test(rows_longer_than_a_span_are_counted_whole),
        cmocka_unit_test(color_distance_has_the_scale_of_pixelmatch),
        cmocka_unit_test(color_distance_is_at_most_1_and_0_only_for_equal_colours),
        cmocka_unit_test(a_palette_change_on_every_line_is_found),
        cmocka_unit_test(a_difference_in_the_lowest_of_16_bits_is_found),
        cmocka_unit_test(image_equals_the_same_image_with_16_bits_a_sample),
        cmocka_unit_test(tolerance_forgives_only_what_it_names),
        cmocka_unit_test(an_antialiased_edge_is_forgiven_and_a_dot_is_not),
        cmocka_unit_test(no_tolerance_forgives_different_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
