/* SPDX-License-Identifier: MIT */
/* test_compare_pixels.c - pixels of every format are compared by their colours, as the definitions say. */
#include "fixture.h"
#include "images.h"
#include "naive_compare.h"
#include "octreel/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 13, HEIGHT = 9, PIXELS = WIDTH * HEIGHT, ROOM = 8 * (WIDTH + 3) * HEIGHT };

static unsigned next_random(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (unsigned)(*state >> 33);
}

/* ---- A picture in every format ------------------------------------------------------------------------------- */

/* The samples of a picture: r, g, b, alpha, from 0 to `most`. */
typedef struct samples {
    unsigned of[PIXELS][4], most;
} samples;

/* How a test's own code stores a format: the place of each stored sample in r, g, b, alpha. */
static const struct {
    int count, bytes, order[4];
} storages[OCTREEL_PIXEL_FORMATS] = {
    [OCTREEL_GREY8] = {1, 1, {0}},          [OCTREEL_RGB8] = {3, 1, {0, 1, 2}},
    [OCTREEL_RGBA8] = {4, 1, {0, 1, 2, 3}}, [OCTREEL_BGRA8] = {4, 1, {2, 1, 0, 3}},
    [OCTREEL_RGB16] = {3, 2, {0, 1, 2}},    [OCTREEL_RGBA16] = {4, 2, {0, 1, 2, 3}},
};

static samples make_samples(octreel_pixel_format format, uint64_t seed)
{
    samples s = {.most = storages[format].bytes == 2 ? 65535 : 255};
    for (int n = 0; n < PIXELS; n++) {
        for (int i = 0; i < 4; i++)
            s.of[n][i] = next_random(&seed) % (s.most + 1);
        if (storages[format].count == 1)
            s.of[n][1] = s.of[n][2] = s.of[n][0];
        if (storages[format].count != 4 || n % 3 == 0)
            s.of[n][3] = s.most;
    }
    return s;
}

/* Store the samples, with `gap` unused bytes behind each row, whose values differ from call to call. */
static octreel_pixels store(const samples *s, octreel_pixel_format format, size_t gap, bool bottom_up,
                            unsigned char room[ROOM])
{
    static unsigned char unused;
    const int bytes = storages[format].bytes, count = storages[format].count;
    const size_t row = (size_t)(WIDTH * bytes * count), stride = row + gap;
    memset(room, ++unused, ROOM);
    for (int n = 0; n < PIXELS; n++) {
        const int y = bottom_up ? HEIGHT - 1 - n / WIDTH : n / WIDTH;
        unsigned char *at = room + (size_t)y * stride + (size_t)(n % WIDTH * bytes * count);
        for (int i = 0; i < count; i++, at += bytes) {
            const unsigned sample = s->of[n][storages[format].order[i]];
            const uint16_t wide = (uint16_t)sample;
            const uint8_t narrow = (uint8_t)sample;
            memcpy(at, bytes == 2 ? (const void *)&wide : &narrow, (size_t)bytes);
        }
    }
    octreel_pixels pixels = octreel_make_pixels(room, WIDTH, HEIGHT, format);
    pixels.stride = gap ? stride : 0;
    pixels.bottom_up = bottom_up;
    return pixels;
}

/* The same picture without alpha: each sample is blended with the background by real numbers. */
static samples blend(const samples *s, uint32_t background)
{
    samples blended = *s;
    for (int n = 0; n < PIXELS; n++) {
        for (int i = 0; i < 3; i++) {
            const double ground = (double)(background >> (16 - 8 * i) & 255) * s->most / 255;
            const double alpha = (double)s->of[n][3] / s->most;
            blended.of[n][i] = (unsigned)lround(s->of[n][i] * alpha + ground * (1 - alpha));
        }
        blended.of[n][3] = s->most;
    }
    return blended;
}

static octreel_comparison compare(const octreel_pixels *a, const octreel_pixels *b, const octreel_compare_def *def)
{
    octreel_comparison found;
    memset(&found, 0xaa, sizeof found);
    const octreel_verdict verdict = octreel_compare_pixels(a, b, def, &found);
    assert_int_equal(verdict, found.verdict);
    assert_true(strlen(found.sentence) > 0 && strlen(found.sentence) < sizeof found.sentence - 1);
    return found;
}

static void same_picture_is_equal_in_every_format(void **state)
{
    static unsigned char room[2][ROOM];
    (void)state;
    octreel_compare_def def = octreel_compare_def_default();
    for (int format = 0; format < OCTREEL_PIXEL_FORMATS; format++) {
        for (int variant = 0; variant < 8; variant++) {
            def.background = variant & 1 ? 0x102030 : 0xffffff;
            const samples s = make_samples((octreel_pixel_format)format, (uint64_t)(format * 8 + variant));
            const samples flat = blend(&s, def.background);
            const octreel_pixels a = store(&s, (octreel_pixel_format)format, variant & 2 ? 5 : 0, variant & 4, room[0]);
            const octreel_pixels b =
                store(&flat, s.most == 255 ? OCTREEL_RGB8 : OCTREEL_RGB16, 0, variant & 2, room[1]);
            const octreel_comparison found = compare(&a, &b, &def);
            if (found.verdict != OCTREEL_VERDICT_SAME || found.different != 0)
                fail_msg("format %d, variant %d: %s", format, variant, found.sentence);
            assert_int_equal(found.width, WIDTH);
            assert_int_equal(found.reference_height, HEIGHT);
            assert_int_equal(found.worst_x, -1);
        }
    }
}

/* Opaque pixels are packed in blocks; a block with one that is not must be noticed, whatever its place. */
static void one_transparent_pixel_is_blended(void **state)
{
    static unsigned char room[2][ROOM];
    (void)state;
    for (int n = 0; n < PIXELS; n++) {
        samples s = make_samples(OCTREEL_RGBA8, (uint64_t)n);
        for (int i = 0; i < PIXELS; i++)
            s.of[i][3] = i != n ? 255 : n % 2 ? 254 : 100;
        const samples flat = blend(&s, 0xffffff);
        const octreel_pixels a = store(&s, OCTREEL_RGBA8, 0, false, room[0]);
        const octreel_pixels b = store(&flat, OCTREEL_RGB8, 0, false, room[1]);
        assert_int_equal(compare(&a, &b, NULL).verdict, OCTREEL_VERDICT_SAME);
    }
}

/* Change the last stored sample of a pixel that is not alpha, by one level. */
static void one_level_of_one_pixel_is_found(void **state)
{
    static unsigned char room[2][ROOM];
    (void)state;
    for (int format = 0; format < OCTREEL_PIXEL_FORMATS; format++) {
        for (int n = 0; n < PIXELS; n += 10) {
            samples s = make_samples((octreel_pixel_format)format, 5);
            s.of[n][3] = s.most;
            const octreel_pixels b = store(&s, (octreel_pixel_format)format, 0, false, room[1]);
            s.of[n][0] += s.of[n][0] == s.most ? -1u : 1u;
            const octreel_pixels a = store(&s, (octreel_pixel_format)format, 3, true, room[0]);
            const octreel_comparison found = compare(&a, &b, NULL);
            assert_int_equal(found.verdict, OCTREEL_VERDICT_DIFFERENT);
            assert_int_equal(found.different, 1);
            assert_int_equal(found.counted, 1);
            assert_int_equal(found.worst_x, n % WIDTH);
            assert_int_equal(found.worst_y, n / WIDTH);
            assert_int_equal(found.min_x, found.max_x);
            assert_int_equal(found.largest_channel, 1);
            assert_int_equal(found.channel_range, s.most);
            assert_contains(found.sentence, "1 of 117 pixels differs");
        }
    }
}

/* Pixels of 16 bits whose samples 8 bits hold are equal to those of 8 bits, transparent ones included. */
static void depth_alone_is_no_difference(void **state)
{
    static unsigned char room[2][ROOM];
    (void)state;
    samples s = make_samples(OCTREEL_RGBA8, 11);
    const octreel_pixels narrow = store(&s, OCTREEL_RGBA8, 0, false, room[0]);
    for (int n = 0; n < PIXELS; n++)
        for (int i = 0; i < 4; i++)
            s.of[n][i] *= 257;
    const octreel_pixels wide = store(&s, OCTREEL_RGBA16, 2, true, room[1]);
    const octreel_comparison found = compare(&wide, &narrow, NULL);
    assert_int_equal(found.verdict, OCTREEL_VERDICT_SAME);
    assert_int_equal(found.channel_range, 255);
}

/* Larger pictures are compared in bands of rows. */
static void one_pixel_of_any_band_is_found(void **state)
{
    enum { SIDE = 300 };
    static unsigned char grey[SIDE * SIDE], rgb[3 * SIDE * SIDE];
    (void)state;
    for (int i = 0; i < SIDE * SIDE; i++) {
        grey[i] = (unsigned char)(i * 7 / 5);
        memset(rgb + 3 * i, grey[i], 3);
    }
    const octreel_pixels a = octreel_make_pixels(grey, SIDE, SIDE, OCTREEL_GREY8);
    const octreel_pixels b = octreel_make_pixels(rgb, SIDE, SIDE, OCTREEL_RGB8);
    octreel_compare_def def = octreel_compare_def_default();
    for (int y = 0; y < SIDE; y += 23) {
        rgb[3 * (y * SIDE + y / 2) + 1] ^= 128;
        for (int antialias = 0; antialias < 2; antialias++) {
            def.antialias = antialias;
            const octreel_comparison found = compare(&a, &b, &def);
            assert_int_equal(found.different, 1);
            assert_int_equal(found.worst_x, y / 2);
            assert_int_equal(found.worst_y, y);
            assert_int_equal(found.max_y, y);
        }
        rgb[3 * (y * SIDE + y / 2) + 1] ^= 128;
    }
    assert_int_equal(compare(&a, &b, NULL).verdict, OCTREEL_VERDICT_SAME);
}

/* ---- Tolerances, against the oracle --------------------------------------------------------------------------- */

static image picture_of(unsigned char *rgb)
{
    return (image){.width = WIDTH, .height = HEIGHT, .channels = 3, .pixels = rgb};
}

static void assert_agrees(const octreel_comparison *found, const image_difference *expected, uint64_t max_pixels)
{
    const image_tally *tally = expected->counted.pixels ? &expected->counted : &expected->unlike;
    assert_int_equal(found->different, expected->unlike.pixels);
    assert_int_equal(found->counted, expected->counted.pixels);
    assert_int_equal(found->close, expected->close);
    assert_int_equal(found->antialiased, expected->antialiased);
    assert_int_equal(found->ignored, expected->ignored);
    assert_int_equal(found->worst_x, tally->worst_x);
    assert_int_equal(found->worst_y, tally->worst_y);
    assert_true(fabs(found->worst_delta - tally->worst_delta) < 1e-12);
    assert_int_equal(found->largest_channel, tally->largest_channel);
    assert_int_equal(found->min_x, tally->min_x);
    assert_int_equal(found->min_y, tally->min_y);
    assert_int_equal(found->max_x, tally->max_x);
    assert_int_equal(found->max_y, tally->max_y);
    assert_int_equal(found->verdict,
                     expected->counted.pixels <= max_pixels ? OCTREEL_VERDICT_SAME : OCTREEL_VERDICT_DIFFERENT);
}

/* Patches of a few colours, so that there are edges, and a second picture with other values here and there. */
static void make_patches(unsigned char a[3 * PIXELS], unsigned char b[3 * PIXELS], uint64_t *random)
{
    for (int n = 0; n < PIXELS; n++) {
        for (int i = 0; i < 3; i++)
            a[3 * n + i] = (unsigned char)(60 * ((n % WIDTH / 4 + n / WIDTH / 3 + i) % 4));
        memcpy(b + 3 * n, a + 3 * n, 3);
        if (next_random(random) % 6 == 0)
            b[3 * n + next_random(random) % 3] ^= (unsigned char)(1u << next_random(random) % 8);
    }
}

static void tolerances_are_those_of_octreel_diff(void **state)
{
    (void)state;
    uint64_t random = 3;
    int same = 0;
    for (int round = 0; round < 400; round++) {
        unsigned char a[3 * PIXELS], b[3 * PIXELS];
        make_patches(a, b, &random);
        const octreel_rectangle ignored[] = {{(int)(next_random(&random) % 13), 2, 5, 3}, {0, 8, 100, 100}};
        octreel_compare_def def = octreel_compare_def_default();
        def.max_delta = (double)(next_random(&random) % 4) / 20;
        def.max_channel = round % 4 == 1 ? round % 97 : 0;
        def.antialias = next_random(&random) % 2;
        def.max_pixels = next_random(&random) % 20;
        def.ignored = ignored;
        def.ignored_count = next_random(&random) % 3;
        const image_tolerance tolerance = {.max_pixels = def.max_pixels,
                                           .max_delta = def.max_delta,
                                           .max_channel = def.max_channel,
                                           .antialias = def.antialias,
                                           .ignored = ignored,
                                           .ignored_count = def.ignored_count};
        const image image_a = picture_of(a), image_b = picture_of(b);
        const image_difference expected = naive_compare(&image_a, &image_b, &tolerance);
        const octreel_pixels of_a = octreel_make_pixels(a, WIDTH, HEIGHT, OCTREEL_RGB8);
        const octreel_pixels of_b = octreel_make_pixels(b, WIDTH, HEIGHT, OCTREEL_RGB8);
        const octreel_comparison found = compare(&of_b, &of_a, &def);
        assert_agrees(&found, &expected, def.max_pixels);
        same += found.verdict == OCTREEL_VERDICT_SAME;
    }
    assert_in_range(same, 40, 360); /* both verdicts occur often */
}

/* ---- Invalid arguments ---------------------------------------------------------------------------------------- */

static void assert_trouble(const octreel_pixels *a, const octreel_pixels *b, const octreel_compare_def *def,
                           const char *reason)
{
    const octreel_comparison found = compare(a, b, def);
    assert_int_equal(found.verdict, OCTREEL_VERDICT_TROUBLE);
    assert_contains(found.sentence, reason);
    assert_int_equal(found.different, 0);
    assert_int_equal(found.max_x, -1);
}

static void invalid_pixels_are_refused(void **state)
{
    (void)state;
    static const unsigned char bytes[16] = {0};
    const octreel_pixels good = octreel_make_pixels(bytes, 2, 2, OCTREEL_RGBA8);
    octreel_pixels bad = good;
    assert_trouble(NULL, &good, NULL, "the picture: the pointer to the pixels is null");
    assert_trouble(&good, NULL, NULL, "the reference: the pointer to the pixels is null");
    bad.data = NULL;
    assert_trouble(&good, &bad, NULL, "the reference: the pointer to the pixels is null");
    bad = good;
    bad.width = 0;
    assert_trouble(&bad, &good, NULL, "the picture: the size is 0x2");
    bad.width = 16385;
    assert_trouble(&bad, &good, NULL, "the size is 16385x2; each side must be from 1 to 16384");
    bad = good;
    bad.format = OCTREEL_PIXEL_FORMATS;
    assert_trouble(&bad, &good, NULL, "6 is not a pixel format");
    bad = good;
    bad.stride = 7;
    assert_trouble(&bad, &good, NULL, "the stride is 7 bytes, but a row of pixels has 8");
    assert_int_equal(octreel_compare_pixels(&bad, &good, NULL, NULL), OCTREEL_VERDICT_TROUBLE);
}

/* One level of green is hardly visible, white on black is. FLIP is measured only if the definition asks for it. */
static void flip_forgives_invisible_differences(void **state)
{
    (void)state;
    enum { SIDE = 8, BYTES = 3 * SIDE * SIDE };
    unsigned char reference[BYTES] = {0}, faint[BYTES] = {0}, white[BYTES];
    memset(white, 255, sizeof white);
    faint[3 * 20 + 1] = 1;
    const octreel_pixels pixels[3] = {octreel_make_pixels(reference, SIDE, SIDE, OCTREEL_RGB8),
                                      octreel_make_pixels(faint, SIDE, SIDE, OCTREEL_RGB8),
                                      octreel_make_pixels(white, SIDE, SIDE, OCTREEL_RGB8)};
    octreel_compare_def def = octreel_compare_def_default();
    octreel_comparison found = compare(&pixels[1], &pixels[0], &def);
    assert_true(found.verdict == OCTREEL_VERDICT_DIFFERENT && found.mean_flip == 0);
    def.flip = true;
    def.max_flip = 0.01;
    found = compare(&pixels[1], &pixels[0], &def);
    assert_true(found.verdict == OCTREEL_VERDICT_SAME && found.mean_flip > 0 && found.mean_flip <= found.worst_flip);
    found = compare(&pixels[2], &pixels[0], &def);
    assert_true(found.verdict == OCTREEL_VERDICT_DIFFERENT && found.mean_flip > 0.5);
    found = compare(&pixels[0], &pixels[0], &def);
    assert_true(found.verdict == OCTREEL_VERDICT_SAME && found.mean_flip == 0);
}

static void invalid_definitions_are_refused(void **state)
{
    (void)state;
    static const unsigned char bytes[4] = {0};
    const octreel_pixels good = octreel_make_pixels(bytes, 2, 2, OCTREEL_GREY8);
    const double deltas[] = {-0.1, 1.1, NAN, INFINITY};
    octreel_compare_def def = octreel_compare_def_default();
    for (size_t i = 0; i < sizeof deltas / sizeof *deltas; i++) {
        def.max_delta = deltas[i];
        assert_trouble(&good, &good, &def, "max_delta is ");
        def = octreel_compare_def_default();
        def.max_share = deltas[i];
        assert_trouble(&good, &good, &def, "max_share is ");
        def = octreel_compare_def_default();
        def.flip = true;
        def.max_flip = deltas[i];
        assert_trouble(&good, &good, &def, "max_flip is ");
        def = octreel_compare_def_default();
    }
    def.flip = true;
    def.pixels_per_degree = 0.5;
    assert_trouble(&good, &good, &def, "pixels_per_degree is 0.5; it must be from 1 to 200");
    def = octreel_compare_def_default();
    def.max_channel = -1;
    assert_trouble(&good, &good, &def, "max_channel is -1; it must be from 0 to 65535");
    def = octreel_compare_def_default();
    def.background = 0x1000000;
    assert_trouble(&good, &good, &def, "background is 0x01000000; it must be 0xRRGGBB");
    def = octreel_compare_def_default();
    def.ignored_count = 1;
    assert_trouble(&good, &good, &def, "ignored is null");
    const octreel_rectangle bad[][2] = {{{0, 0, 1, 1}, {-1, 0, 1, 1}}, {{0, 0, 1, 1}, {0, 0, 0, 1}}};
    def.ignored_count = 2;
    for (int i = 0; i < 2; i++) {
        def.ignored = bad[i];
        assert_trouble(&good, &good, &def, "ignored[1] is the rectangle");
    }
}

static void other_size_is_a_difference(void **state)
{
    (void)state;
    static const unsigned char bytes[12] = {0};
    const octreel_pixels a = octreel_make_pixels(bytes, 4, 3, OCTREEL_GREY8);
    const octreel_pixels b = octreel_make_pixels(bytes, 3, 4, OCTREEL_GREY8);
    const octreel_comparison found = compare(&a, &b, NULL);
    assert_int_equal(found.verdict, OCTREEL_VERDICT_DIFFERENT);
    assert_string_equal(found.sentence,
                        "the picture, compared with the reference: the reference is 3x4, the frame is 4x3");
    assert_int_equal(found.different, 0);
    assert_int_equal(found.width, 4);
    assert_int_equal(found.reference_width, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_picture_is_equal_in_every_format),
        cmocka_unit_test(one_level_of_one_pixel_is_found),
        cmocka_unit_test(depth_alone_is_no_difference),
        cmocka_unit_test(tolerances_are_those_of_octreel_diff),
        cmocka_unit_test(invalid_pixels_are_refused),
        cmocka_unit_test(flip_forgives_invisible_differences),
        cmocka_unit_test(invalid_definitions_are_refused),
        cmocka_unit_test(other_size_is_a_difference),
        cmocka_unit_test(one_pixel_of_any_band_is_found),
        cmocka_unit_test(one_transparent_pixel_is_blended),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
