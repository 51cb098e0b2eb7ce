/* SPDX-License-Identifier: MIT */
/* test_image.c - images in memory: creation, digests, palettes and drawn differences. */
#include "images.h"
#include "image_digest.h"
#include "octree/digest.h"
#include "octree/sample.h"

static void create_refuses_sides_and_channels_out_of_range(void **state)
{
    (void)state;
    static const int refused[][3] = {{0, 1, 1}, {1, 0, 1}, {-1, 5, 3}, {16385, 1, 1}, {1, 16385, 3}, {4, 4, 2}};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        image image;
        assert_false(image_create(&image, refused[i][0], refused[i][1], refused[i][2]));
        assert_null(image.pixels);
        image_release(&image);
    }
}

static void created_image_is_all_zero_and_release_empties_it(void **state)
{
    (void)state;
    image image;
    assert_true(image_create(&image, 7, 5, 3));
    for (int n = 0; n < 7 * 5 * 3; n++)
        assert_int_equal(image.pixels[n], 0);
    image_release(&image);
    assert_null(image.pixels);
    image_release(&image);
}

static void digest_depends_on_size_and_colours_only(void **state)
{
    (void)state;
    image_twins twins = make_twins(37, 11);
    image turned = twins.rgb;
    turned.width = 11;
    turned.height = 37;
    for (int n = 0; n < IMAGE_DIGEST_KINDS; n++) {
        const image_digest_kind kind = (image_digest_kind)n;
        const uint64_t digest = image_digest_with(kind, &twins.rgb);
        assert_true(image_digest_with(kind, &twins.indexed) == digest);
        assert_true(image_digest_with(kind, &turned) != digest);
    }
    release_twins(&twins);
}

static void digest_changes_with_any_channel_of_any_pixel(void **state)
{
    (void)state;
    image blank;
    assert_true(image_create(&blank, 23, 9, 3));
    for (int kind = 0; kind < IMAGE_DIGEST_KINDS; kind++) {
        const uint64_t digest = image_digest_with((image_digest_kind)kind, &blank);
        uint64_t before = digest;
        for (size_t i = 0; i < 23 * 9 * 3; i++) {
            blank.pixels[i] = 1;
            const uint64_t changed = image_digest_with((image_digest_kind)kind, &blank);
            assert_true(changed != digest && changed != before);
            before = changed;
            blank.pixels[i] = 0;
        }
    }
    image_release(&blank);
}

/* As it is defined, without regard to what is equal to the row above. */
static uint64_t digest_rows_by_the_letter(const image *image)
{
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, (uint64_t)image->width);
    digest = octree_digest_word(digest, (uint64_t)image->height);
    for (int y = 0; y < image->height; y++) {
        uint64_t row = 0;
        for (int x = 0; x < image->width; x += 8) {
            uint64_t group = 0;
            for (int i = 0; i < 8 && x + i < image->width; i++) {
                const image_color c = image_color_at(image, x + i, y);
                group += octree_digest_word(~(uint64_t)i, (uint64_t)c.r << 16 | (uint64_t)c.g << 8 | c.b);
            }
            row += octree_digest_word((uint64_t)(x / 8), group);
        }
        digest = octree_digest_word(digest, row);
    }
    return digest;
}

static void digest_of_rows_equals_its_definition(void **state)
{
    (void)state;
    for (int width = 1; width < 70; width++) {
        image_twins twins = make_twins(width, 40);
        for (int y = 1; y < 40; y++) /* rows that repeat the one above, or nearly so */
            if (y % 3 > 0)
                for (int x = 0; x < width - (y % 3 == 2); x++) {
                    uint8_t *index = twins.indexed.pixels + y * width + x,
                            *rgb = twins.rgb.pixels + 3 * (y * width + x);
                    *index = *(index - width);
                    memcpy(rgb, rgb - 3 * width, 3);
                }
        const uint64_t expected = digest_rows_by_the_letter(&twins.rgb);
        assert_true(image_digest_with(IMAGE_DIGEST_ROWS, &twins.rgb) == expected);
        assert_true(image_digest_with(IMAGE_DIGEST_ROWS, &twins.indexed) == expected);
        release_twins(&twins);
    }
}

/* Pictures that differ in one pixel, or in two that are exchanged, have digests that differ in half their bits. */
static void digests_of_small_changes_are_far_apart(void **state)
{
    (void)state;
    enum { SIDE = 64, CHANGES = 4000 };
    uint64_t random = 1;
    int64_t bits = 0;
    image picture;
    assert_true(image_create(&picture, SIDE, SIDE, 1));
    picture.palette.count = 256;
    for (int i = 0; i < 256; i++)
        picture.palette.colors[i] = (image_color){(uint8_t)(i & 1 ? 255 : 0), (uint8_t)(i >> 1), 0};
    for (int i = 0; i < SIDE; i++)
        picture.pixels[i * (SIDE + 1)] = 1; /* a line on one ground */
    const uint64_t before = image_digest(&picture);
    for (int n = 0; n < CHANGES; n++) {
        uint8_t *a = picture.pixels + octree_random(&random) % (SIDE * SIDE), *b = picture.pixels + n;
        const uint8_t old[2] = {*a, *b};
        if (n % 2 == 0 && *a != *b) { /* exchanged */
            *a = old[1];
            *b = old[0];
        } else {
            *b ^= 1 + (n & 6);
        }
        for (uint64_t unlike = image_digest(&picture) ^ before; unlike != 0; unlike &= unlike - 1)
            bits++;
        *a = old[0];
        *b = old[1];
    }
    assert_true(bits / CHANGES >= 31 && bits / CHANGES <= 33);
    assert_true(image_digest(&picture) == before);
    image_release(&picture);
}

/* Files have these texts. */
static void digest_of_each_kind_is_pinned_and_its_text_names_the_kind(void **state)
{
    (void)state;
    static const char *const texts[IMAGE_DIGEST_KINDS] = {"5f63f82b7be5075e", "rows-4f2058f8635040af"};
    image_twins twins = make_twins(37, 11);
    for (int kind = 0; kind < IMAGE_DIGEST_KINDS; kind++) {
        const uint64_t digest = image_digest_with((image_digest_kind)kind, &twins.indexed);
        char text[IMAGE_DIGEST_TEXT];
        image_digest_kind told;
        uint64_t read;
        assert_string_equal(image_digest_print((image_digest_kind)kind, digest, text), texts[kind]);
        assert_true(image_digest_parse(texts[kind], &told, &read));
        assert_true((int)told == kind && read == digest);
    }
    release_twins(&twins);
}

static void text_that_is_not_a_digest_is_refused(void **state)
{
    (void)state;
    static const char *const texts[] = {"",
                                        "0123456789abcde",
                                        "0123456789abcdef0",
                                        "0123456789ABCDEF",
                                        "-0123456789abcdef",
                                        " 0123456789abcdef",
                                        "0x23456789abcdef",
                                        "runs-0123456789abcdef",
                                        "rows-0123456789abcde",
                                        "rows-0123456789abcdef ",
                                        "rows0123456789abcdef",
                                        "rows-",
                                        "later-0123456789abcdef"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        image_digest_kind kind = IMAGE_DIGEST_KINDS;
        uint64_t digest = 7;
        assert_false(image_digest_parse(texts[i], &kind, &digest));
        assert_true(kind == IMAGE_DIGEST_KINDS && digest == 7);
    }
}

static void comparison_ignores_how_palettes_are_ordered(void **state)
{
    (void)state;
    image_twins a = make_twins(30, 30);
    image_twins b = make_twins(30, 30);
    for (int n = 0; n < 900; n++)
        b.indexed.pixels[n] = b.indexed.pixels[n] == 3 ? 2 : b.indexed.pixels[n]; /* the same colour, another index */
    image_difference difference = image_compare(&a.indexed, &b.indexed);
    assert_true(image_has_no_difference(&difference));
    b.indexed.palette.colors[0].g ^= 2; /* the same index, another colour */
    difference = image_compare(&a.indexed, &b.indexed);
    assert_int_equal(difference.unlike.largest_channel, 2);
    release_twins(&a);
    release_twins(&b);
}

static void row_holds_the_colour_of_each_pixel_in_each_format(void **state)
{
    (void)state;
    static const struct {
        int channels;
        bool wide;
    } formats[] = {{1, false}, {3, false}, {3, true}};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        image of;
        image_color row[7];
        assert_true(image_create(&of, formats[i].wide ? 14 : 7, 3, formats[i].channels)); /* 16 bits fill 14 columns */
        for (int n = 0; n < of.width * of.height * of.channels; n++)
            of.pixels[n] = (uint8_t)(n * 37 % 251);
        for (int n = 0; n < 256; n++)
            of.palette.colors[n] = (image_color){(uint8_t)n, (uint8_t)(n ^ 85), (uint8_t)(255 - n)};
        of.wide = formats[i].wide;
        of.width = 7;
        for (int y = 0; y < 3; y++) {
            image_read_row(&of, y, row);
            for (int x = 0; x < 7; x++) {
                const image_color color = image_color_at(&of, x, y);
                assert_memory_equal(&row[x], &color, sizeof color);
            }
        }
        image_release(&of);
    }
}

/* The names are in files: none may change or go. */
static void each_kind_of_digest_is_found_by_its_name(void **state)
{
    (void)state;
    assert_string_equal(image_digest_kind_name(IMAGE_DIGEST_RUNS), "runs");
    for (int kind = 0; kind < IMAGE_DIGEST_KINDS; kind++) {
        const char *name = image_digest_kind_name((image_digest_kind)kind);
        assert_int_equal(image_find_digest_kind(name, strlen(name)), kind);
        assert_int_equal(image_find_digest_kind(name, strlen(name) - 1), IMAGE_DIGEST_KINDS);
    }
    assert_int_equal(image_find_digest_kind("", 0), IMAGE_DIGEST_KINDS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(create_refuses_sides_and_channels_out_of_range),
        cmocka_unit_test(created_image_is_all_zero_and_release_empties_it),
        cmocka_unit_test(digest_depends_on_size_and_colours_only),
        cmocka_unit_test(digest_changes_with_any_channel_of_any_pixel),
        cmocka_unit_test(each_kind_of_digest_is_found_by_its_name),
        cmocka_unit_test(digest_of_rows_equals_its_definition),
        cmocka_unit_test(digests_of_small_changes_are_far_apart),
        cmocka_unit_test(digest_of_each_kind_is_pinned_and_its_text_names_the_kind),
        cmocka_unit_test(text_that_is_not_a_digest_is_refused),
        cmocka_unit_test(comparison_ignores_how_palettes_are_ordered),
        cmocka_unit_test(row_holds_the_colour_of_each_pixel_in_each_format),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
