/* SPDX-License-Identifier: MIT */
/* test_cloud_las.c - the LAS reader, held against the tables of the specification: LAS 1.0 to 1.5, point formats 0 to
 * 10. */
#include "las_files.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double two_read[2][3] = {{1, 2, 30 * 0.1}, {-4.5, 5e10 + 2, 0.1}};

/* ---- What is read ------------------------------------------------------------------------------------------- */

static void las_is_read_in_every_version_and_point_format(void **state)
{
    (void)state;
    for (unsigned minor = 0; minor < LAS_VERSIONS; minor++)
        for (unsigned format = 0; format < LAS_FORMATS; format++)
            for (unsigned more = 0; more < 4; more++) {
                las l = two_points_of_format(minor, format);
                l.extra = more & 1 ? 7 : 0;
                l.records_before = more & 2 ? 61 : 0;
                const bytes file = make_las_file(&l);
                assert_reads("a.las", file.data, file.size, two_read, 2, 0);
                assert_reads("content decides.xyz", file.data, file.size, two_read, 2, 0);
            }
}

static void truncated_las_is_refused(void **state)
{
    (void)state;
    for (unsigned minor = 0; minor < LAS_VERSIONS; minor++) {
        const las l = two_points_of_format(minor, minor < 4 ? 3 : 7);
        const bytes file = make_las_file(&l);
        assert_refuses_every_beginning("a.las", &file);
    }
}

/* A product and a sum, each rounded once: what the specification writes, and what laspy and PDAL compute. */
static void las_coordinate_is_a_product_and_a_sum_of_doubles(void **state)
{
    static const struct {
        int32_t record;
        double scale, offset;
    } rows[] = {
        {INT32_MAX, 0.001, 500000},  {INT32_MIN, 0.001, 5400000.123},
        {1234567891, 0.01, -0.1},    {-987654321, 1.0 / 3, 1e9 / 7},
        {1, 0x1p-1074, 0},           {INT32_MIN, 0x1p-1074, 0},
        {3, 0x1.8p-1073, 0x1p-1074}, {7, -0.1, 0.7},
        {INT32_MAX, 1e290, -1e299},  {1, 0x1p-52, 1},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        las l = two;
        l.scale[1] = rows[i].scale;
        l.offset[1] = rows[i].offset;
        l.points[0][1] = rows[i].record;
        l.points[1][1] = 0;
        const volatile double product = (double)rows[i].record * rows[i].scale, sum = product + rows[i].offset;
        const double expected[2][3] = {{1, sum, two_read[0][2]}, {-4.5, rows[i].offset, 0.1}};
        const bytes file = make_las_file(&l);
        assert_reads("a.las", file.data, file.size, expected, 2, 0);
    }
}

static void las_1_0_may_have_a_signature_before_its_points(void **state)
{
    const las l = two;
    bytes file = {.size = 0};
    (void)state;
    put_header(&file, &l);
    put_bits(&file, 0xccdd, 2, false);
    for (int i = 0; i < 2; i++)
        put_record(&file, &l, l.points[i]);
    assert_reads("points at it.las", file.data, file.size, two_read, 2, 0);
    set_bits(&file, 96, 229, 4);
    assert_reads("points behind it.las", file.data, file.size, two_read, 2, 0);
    las same = two;
    same.points[0][0] = 0xccdd;
    same.scale[0] = 1;
    const double expected[2][3] = {{0xccdd + 1.5, 2, two_read[0][2]}, {-10.5, two_read[1][1], 0.1}};
    file = make_las_file(&same);
    assert_reads("a coordinate that looks like it.las", file.data, file.size, expected, 2, 0);
}

static void las_counts_of_either_kind_are_read(void **state)
{
    const las l = two_points_of_format(4, 2);
    bytes file = make_las_file(&l);
    (void)state;
    set_bits(&file, 107, 0, 4);
    assert_reads("the wide one alone.las", file.data, file.size, two_read, 2, 0);
    set_bits(&file, 107, 2, 4);
    set_bits(&file, 247, 0, 8);
    assert_reads("the narrow one alone.las", file.data, file.size, two_read, 2, 0);
}

/* "Withheld" is the specification's word for deleted. In LAS 1.0 the bit is a part of the class. */
static void withheld_las_points_are_skipped_but_count_as_rows(void **state)
{
    (void)state;
    for (unsigned minor = 0; minor < LAS_VERSIONS; minor++)
        for (unsigned format = 0; format < LAS_FORMATS; format++) {
            const las l = two_points_of_format(minor, format);
            bytes file = make_las_file(&l);
            cloud cloud;
            octreel_error error;
            file.data[las_header_sizes[minor] + 15] = format < 6 ? 0x80 : 0x04;
            assert_true(cloud_parse("a.las", file.data, file.size, &cloud, &error));
            assert_int_equal(cloud.count, minor == 0 ? 2 : 1);
            assert_int_equal(cloud.skipped, minor == 0 ? 0 : 1);
            assert_int_equal(cloud_row_number(&cloud, cloud.count - 1), 1);
            if (minor > 0)
                assert_string_equal(cloud.why_skipped, "marked as withheld");
            cloud_release(&cloud);
        }
}

static void las_with_only_withheld_points_is_refused(void **state)
{
    const las l = two_points_of_format(2, 0);
    bytes file = make_las_file(&l);
    (void)state;
    file.data[227 + 15] = 0x80;
    file.data[227 + 20 + 15] = 0xff;
    assert_refuses("a.las", file.data, file.size,
                   "a.las: holds no points that can be read: all 2 are marked as withheld");
}

/* ---- What follows the points -------------------------------------------------------------------------------- */

static void las_bytes_beyond_the_last_point_are_noted_unless_the_header_names_them(void **state)
{
    las l = two_points_of_format(4, 4);
    bytes file = make_las_file(&l);
    char note[128];
    const size_t end = file.size;
    (void)state;
    put_zeros(&file, 5);
    assert_reads("a.las", file.data, file.size, two_read, 2, 0);
    put_text(&file, "record");
    snprintf(note, sizeof note,
             "a.las:byte %zu: the file has more data than its header says; the points before this place were read",
             end + 5);
    assert_reads_and_notes("a.las", file.data, file.size, two_read, 2, 0, note);
    set_bits(&file, 235, end + 5, 8);
    set_bits(&file, 243, 1, 4);
    assert_reads("named as a record.las", file.data, file.size, two_read, 2, 0);
    set_bits(&file, 243, 0, 4);
    set_bits(&file, 227, end + 5, 8);
    assert_reads("named as a waveform.las", file.data, file.size, two_read, 2, 0);
    set_bits(&file, 227, end + 6, 8);
    assert_reads_and_notes("a.las", file.data, file.size, two_read, 2, 0, note);
}

static void las_points_that_overlap_later_parts_are_refused(void **state)
{
    las l = two_points_of_format(4, 4);
    bytes file = make_las_file(&l);
    (void)state;
    set_bits(&file, 227, 488, 8);
    assert_refuses("a.las", file.data, file.size,
                   "a.las:byte 227: the waveforms begin at byte 488, outside of 489 (the end of the points) to 489 "
                   "(the end of the file)");
    set_bits(&file, 227, 490, 8);
    assert_refuses("a.las", file.data, file.size,
                   "a.las:byte 227: the waveforms begin at byte 490, outside of 489 (the end of the points) to 489 "
                   "(the end of the file)");
    set_bits(&file, 227, 0, 8);
    set_bits(&file, 235, UINT64_MAX, 8);
    assert_reads("none is counted.las", file.data, file.size, two_read, 2, 0);
    set_bits(&file, 243, 1, 4);
    assert_refuses(
        "a.las", file.data, file.size,
        "a.las:byte 235: the extended records begin at byte 18446744073709551615, outside of 489 (the end of "
        "the points) to 489 (the end of the file)");
}

/* ---- Headers that cannot be followed ------------------------------------------------------------------------ */

static void invalid_las_headers_are_refused(void **state)
{
    static const struct {
        unsigned minor, format;
        size_t at;
        unsigned size;
        uint64_t bits;
        const char *sentence;
    } rows[] = {
        {2, 3, 0, 1, 'l', ":byte 0: is not a LAS file: its first bytes are not LASF"},
        {2, 3, 24, 1, 2, ":byte 24: LAS 2.2 is not a supported version of LAS; versions 1.0 to 1.5 are"},
        {2, 3, 25, 1, 6, ":byte 24: LAS 1.6 is not a supported version of LAS; versions 1.0 to 1.5 are"},
        {2, 3, 94, 2, 226,
         ":byte 94: the header gives its size as 226 bytes, but a header of LAS 1.2 has at least 227"},
        {4, 3, 94, 2, 227,
         ":byte 94: the header gives its size as 227 bytes, but a header of LAS 1.4 has at least 375"},
        {2, 3, 94, 2, 65535,
         ":byte 94: the header gives its size as 65535 bytes, but the points begin inside it, at byte 227"},
        {2, 3, 96, 4, 226,
         ":byte 94: the header gives its size as 227 bytes, but the points begin inside it, at byte 226"},
        {2, 3, 96, 4, 296,
         ":byte 96: the header says that the points begin at byte 296, but the file has only 295 bytes"},
        {2, 3, 96, 4, UINT32_MAX,
         ":byte 96: the header says that the points begin at byte 4294967295, but the file has only 295 bytes"},
        {2, 3, 104, 1, 11, ":byte 104: 11 is not a supported point format; formats 0 to 10 are"},
        {2, 3, 104, 1, 63, ":byte 104: 63 is not a supported point format; formats 0 to 10 are"},
        {2, 3, 105, 2, 33,
         ":byte 105: the header says that a point has 33 bytes, but points of format 3 have at least 34"},
        {2, 0, 105, 2, 0,
         ":byte 105: the header says that a point has 0 bytes, but points of format 0 have at least 20"},
        {2, 3, 107, 4, 0, ": holds no points"},
        {2, 3, 107, 4, 3, ":byte 227: 3 points of 34 bytes each should follow, but the file has only 68 bytes left"},
        {2, 3, 107, 4, UINT32_MAX,
         ":byte 227: 4294967295 points of 34 bytes each should follow, but the file has only 68 bytes left"},
        {4, 3, 247, 8, 1, ":byte 247: the count of points is 1 here but 2 at byte 107; correct the header"},
        {4, 6, 247, 8, UINT64_MAX,
         ":byte 375: 18446744073709551615 points of 30 bytes each should follow, but the file has only 60 bytes left"},
        {4, 6, 247, 8, UINT64_C(1) << 63,
         ":byte 375: 9223372036854775808 points of 30 bytes each should follow, but the file has only 60 bytes left"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const las l = two_points_of_format(rows[i].minor, rows[i].format);
        char sentence[256];
        bytes file = make_las_file(&l);
        set_bits(&file, rows[i].at, rows[i].bits, rows[i].size);
        snprintf(sentence, sizeof sentence, "a.las%s", rows[i].sentence);
        assert_refuses("a.las", file.data, file.size, sentence);
    }
}

static void las_scales_without_valid_coordinates_are_refused(void **state)
{
    static const struct {
        size_t at;
        double value;
        const char *sentence;
    } rows[] = {
        {131, 0, "a.las:byte 131: the scale of x is 0, which gives no valid coordinates"},
        {139, -0.0, "a.las:byte 139: the scale of y is -0, which gives no valid coordinates"},
        {147, NAN, "a.las:byte 147: the scale of z is nan, which gives no valid coordinates"},
        {131, INFINITY, "a.las:byte 131: the scale of x is inf, which gives no valid coordinates"},
        {163, NAN, "a.las:byte 163: the offset of y is nan, which gives no valid coordinates"},
        {171, -INFINITY, "a.las:byte 171: the offset of z is -inf, which gives no valid coordinates"},
        {131, 1e308, "a.las:byte 247: x is beyond the largest double"},
        {131, -1.7e308, "a.las:byte 247: x is beyond the largest double"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        bytes file = make_las_file(&two);
        set_double(&file, rows[i].at, rows[i].value);
        assert_refuses("a.las", file.data, file.size, rows[i].sentence);
    }
}

static void compressed_las_is_refused_with_advice(void **state)
{
    static const unsigned flags[] = {0x80, 0x40, 0xc0};
    (void)state;
    if (cloud_can_read_laz())
        skip();
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++) {
        const las l = two_points_of_format(4, 7);
        bytes file = make_las_file(&l);
        file.data[104] |= flags[i];
        assert_refuses(
            "a.laz", file.data, file.size,
            "a.laz: is compressed LAS (LAZ or COPC), but this octreel was built without liblaszip; install "
            "liblaszip-dev (Debian 13) and build again, or decompress the file: pdal translate in.laz out.las");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(las_is_read_in_every_version_and_point_format),
        cmocka_unit_test(truncated_las_is_refused),
        cmocka_unit_test(las_coordinate_is_a_product_and_a_sum_of_doubles),
        cmocka_unit_test(las_1_0_may_have_a_signature_before_its_points),
        cmocka_unit_test(las_counts_of_either_kind_are_read),
        cmocka_unit_test(withheld_las_points_are_skipped_but_count_as_rows),
        cmocka_unit_test(las_with_only_withheld_points_is_refused),
        cmocka_unit_test(las_bytes_beyond_the_last_point_are_noted_unless_the_header_names_them),
        cmocka_unit_test(las_points_that_overlap_later_parts_are_refused),
        cmocka_unit_test(invalid_las_headers_are_refused),
        cmocka_unit_test(las_scales_without_valid_coordinates_are_refused),
        cmocka_unit_test(compressed_las_is_refused_with_advice),
    };
    return cmocka_run_group_tests_name("cloud_las", tests, NULL, NULL);
}
