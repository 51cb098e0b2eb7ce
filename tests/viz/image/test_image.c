/* SPDX-License-Identifier: MIT */
/* test_image.c - images in memory: creation, digests, palettes and drawn differences. */
#include "images.h"
#include "image_digest.h"

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

static void digest_is_of_size_and_colours_alone(void **state)
{
    (void)state;
    image_twins twins = make_twins(37, 11);
    uint64_t digest = image_digest(&twins.rgb);
    assert_true(image_digest(&twins.indexed) == digest);
    twins.rgb.width = 11;
    twins.rgb.height = 37;
    assert_true(image_digest(&twins.rgb) != digest);
    release_twins(&twins);
}

static void digest_changes_with_any_channel_of_any_pixel(void **state)
{
    (void)state;
    image blank;
    assert_true(image_create(&blank, 23, 9, 3));
    uint64_t digest = image_digest(&blank);
    uint64_t before = digest;
    for (size_t i = 0; i < 23 * 9 * 3; i++) {
        blank.pixels[i] = 1;
        uint64_t changed = image_digest(&blank);
        assert_true(changed != digest && changed != before);
        before = changed;
        blank.pixels[i] = 0;
    }
    image_release(&blank);
}

static void compare_sees_through_palettes(void **state)
{
    (void)state;
    image_twins a = make_twins(30, 30);
    image_twins b = make_twins(30, 30);
    for (int n = 0; n < 900; n++)
        b.indexed.pixels[n] = b.indexed.pixels[n] == 3 ? 2 : b.indexed.pixels[n]; /* the same colour, another index */
    image_difference difference = image_compare(&a.indexed, &b.indexed);
    assert_true(image_same(&difference));
    b.indexed.palette.colors[0].g ^= 2; /* the same index, another colour */
    difference = image_compare(&a.indexed, &b.indexed);
    assert_int_equal(difference.unlike.largest_channel, 2);
    release_twins(&a);
    release_twins(&b);
}

/* The names are in files: none may change or go. */
static void each_kind_of_digest_is_found_by_its_name(void **state)
{
    (void)state;
    assert_string_equal(image_digest_kind_name(IMAGE_DIGEST_RUNS), "runs");
    for (int kind = 0; kind < IMAGE_DIGEST_KINDS; kind++) {
        const char *name = image_digest_kind_name((image_digest_kind)kind);
        assert_int_equal(image_digest_kind_of(name, strlen(name)), kind);
        assert_int_equal(image_digest_kind_of(name, strlen(name) - 1), IMAGE_DIGEST_KINDS);
    }
    assert_int_equal(image_digest_kind_of("", 0), IMAGE_DIGEST_KINDS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(create_refuses_sides_and_channels_out_of_range),
        cmocka_unit_test(created_image_is_all_zero_and_release_empties_it),
        cmocka_unit_test(digest_is_of_size_and_colours_alone),
        cmocka_unit_test(digest_changes_with_any_channel_of_any_pixel),
        cmocka_unit_test(each_kind_of_digest_is_found_by_its_name),
        cmocka_unit_test(compare_sees_through_palettes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
