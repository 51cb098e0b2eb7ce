/* SPDX-License-Identifier: MIT */
/* test_lettering.c - letters grow with the picture in whole multiples, and keep within a range of its height. */
#include "fixture.h"
#include "lettering.h"

static lettering text_at(int width, int height)
{
    const view v = {.width = width, .height = height};
    return lettering_choose(&v, false);
}

static void common_picture_sizes_have_the_faces_of_the_table(void **state)
{
    (void)state;
    static const struct {
        int width, height, letter, cell;
    } rows[] = {{320, 180, 5, 8},     {640, 360, 6, 12},    {960, 540, 6, 12},    {1280, 720, 8, 16},
                {1920, 1080, 12, 24}, {2560, 1440, 16, 32}, {3840, 2160, 24, 48}, {7680, 4320, 48, 96},
                {720, 1280, 6, 12},   {5000, 720, 8, 16},   {1, 1, 5, 8},         {16384, 16384, 108, 216}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const lettering l = text_at(rows[i].width, rows[i].height);
        assert_int_equal(l.width, rows[i].letter);
        assert_int_equal(l.height, rows[i].cell);
    }
}

/* Cells of letters are whole multiples of their face's cell, and larger pictures never have smaller letters. From a
 * height of 360 pixels on, 27 to 54 lines of text fit. */
static void letters_grow_with_the_picture(void **state)
{
    (void)state;
    lettering before = text_at(16, 9);
    for (int height = 9; height <= 9216; height += 3) {
        const view v = {.width = height * 16 / 9 + 16, .height = height};
        const lettering l = lettering_choose(&v, false), title = lettering_choose(&v, true);
        assert_true(l.height >= before.height && l.width >= before.width);
        assert_true(l.line > l.height && l.line <= l.height * 5 / 4);
        assert_true(title.width > l.width && title.width <= 2 * l.width && title.height == 2 * l.height);
        assert_true(height < 360 || (height / l.line >= 27 && height / l.line <= 54));
        before = l;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(common_picture_sizes_have_the_faces_of_the_table),
        cmocka_unit_test(letters_grow_with_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
