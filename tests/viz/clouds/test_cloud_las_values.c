/* SPDX-License-Identifier: MIT */
/* test_cloud_las_values.c - colours, intensities and classes of LAS, by the specification's tables of point formats. */
#include "las_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Two records in which each byte from the intensity on is its place in the record, but for the flags. */
static bytes make_counting(unsigned minor, unsigned format)
{
    const las l = two_points_of_format(minor, format);
    bytes file = make_las_file(&l);
    const size_t length = las_record_sizes[format], first = file.size - 2 * length;
    for (size_t i = 12; i < length; i++)
        for (size_t record = 0; record < 2; record++)
            file.data[first + record * length + i] = (unsigned char)(i == 15 ? 0x0b : i);
    return file;
}

static cloud read_cloud(const bytes *file)
{
    cloud c;
    octreel_error error;
    if (!cloud_parse("a.las", file->data, file->size, &c, &error))
        fail_msg("%s", error.text);
    return c;
}

static void las_has_values_where_the_point_format_has_them(void **state)
{
    /* three 16-bit channels from byte 20, 28 or 30 on, of which the upper bytes are kept */
    static const char *const colors[LAS_FORMATS] = {[2] = "\x15\x17\x19", [3] = "\x1d\x1f\x21", [5] = "\x1d\x1f\x21",
                                                    [7] = "\x1f\x21\x23", [8] = "\x1f\x21\x23", [10] = "\x1f\x21\x23"};
    (void)state;
    for (unsigned minor = 0; minor < LAS_VERSIONS; minor++)
        for (unsigned format = 0; format < LAS_FORMATS; format++) {
            const bytes file = make_counting(minor, format);
            cloud c = read_cloud(&file);
            assert_int_equal(c.values.count, 2);
            assert_int_equal(c.color_full, colors[format] ? 65535 : 0);
            for (size_t i = 0; i < 2; i++) {
                const point_value v = point_values_get(&c.values, i);
                assert_int_equal(v.has[POINT_COLOR], colors[format] != NULL);
                if (colors[format])
                    assert_memory_equal(v.color, colors[format], 3);
                assert_true(v.has[POINT_INTENSITY] && v.intensity == 0x0d0c);
                assert_true(v.has[POINT_CLASS]);
                assert_int_equal(v.class, format < 6 ? 11 : 16);
            }
            cloud_release(&c);
        }
}

/* The bits above the class are flags from LAS 1.1 on. */
static void las_classes_have_five_bits_or_eight(void **state)
{
    static const struct {
        unsigned minor, format, class;
    } rows[] = {{0, 0, 0x7f}, {1, 0, 0x1f}, {2, 3, 0x1f}, {4, 5, 0x1f}, {4, 6, 0xff}, {4, 10, 0xff}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const las l = two_points_of_format(rows[i].minor, rows[i].format);
        bytes file = make_las_file(&l);
        if (rows[i].minor == 0)
            file.data[file.size - 2 * las_record_sizes[0] + 15] = 0x7f;
        cloud c = read_cloud(&file);
        assert_int_equal(point_values_get(&c.values, 0).class, rows[i].class);
        cloud_release(&c);
    }
}

static void set_colors(bytes *file, unsigned first, unsigned second)
{
    for (unsigned i = 0; i < 3; i++) {
        set_bits(file, file->size - 2 * 26 + 20 + 2 * i, first, 2);
        set_bits(file, file->size - 26 + 20 + 2 * i, second, 2);
    }
}

/* Many files have 8-bit colours in the 16 bits. */
static void las_colour_scale_follows_from_the_largest_channel(void **state)
{
    static const struct {
        unsigned first, second, full, read[2];
    } rows[] = {{255, 1, 255, {255, 1}}, {255, 256, 65535, {0, 1}}, {256, 255, 65535, {1, 0}}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        bytes file = make_counting(2, 2);
        set_colors(&file, rows[i].first, rows[i].second);
        cloud c = read_cloud(&file);
        assert_int_equal(c.color_full, rows[i].full);
        for (size_t j = 0; j < 2; j++)
            assert_int_equal(point_values_get(&c.values, j).color[2], rows[i].read[j]);
        cloud_release(&c);
    }
}

/* Class 0 means "never classified", but a colour or an intensity of zero may mean that the writer had none. */
static void las_colours_and_intensities_that_are_zero_in_every_point_are_missing(void **state)
{
    bytes file = make_counting(2, 2);
    (void)state;
    set_colors(&file, 0, 0);
    cloud c = read_cloud(&file);
    assert_false(point_values_kinds(&c.values) >> POINT_COLOR & 1);
    assert_int_equal(c.color_full, 0);
    assert_true(point_values_get(&c.values, 1).has[POINT_CLASS]);
    assert_string_equal(c.column_note, "colours are zero in every point and are treated as missing");
    cloud_release(&c);
    for (size_t i = 12; i < 26; i++)
        for (size_t record = 1; record < 3; record++)
            file.data[file.size - 26 * record + i] = 0;
    c = read_cloud(&file);
    assert_int_equal(point_values_kinds(&c.values), 1U << POINT_CLASS);
    assert_true(point_values_get(&c.values, 1).has[POINT_CLASS]);
    assert_false(point_values_get(&c.values, 1).has[POINT_INTENSITY]);
    assert_string_equal(c.column_note, "colours and intensities are zero in every point and are treated as missing");
    cloud_release(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(las_has_values_where_the_point_format_has_them),
        cmocka_unit_test(las_classes_have_five_bits_or_eight),
        cmocka_unit_test(las_colour_scale_follows_from_the_largest_channel),
        cmocka_unit_test(las_colours_and_intensities_that_are_zero_in_every_point_are_missing),
    };
    return cmocka_run_group_tests_name("cloud_las values", tests, NULL, NULL);
}
