/* SPDX-License-Identifier: MIT */
/* test_cloud_ply.c - the PLY reader. */
#include "clouds.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void ply_ascii_skips_other_elements_and_lists(void **state)
{
    static const char text[] = "ply\nformat ascii 1.0\ncomment made by hand\nobj_info of two points\n"
                               "element camera 1\nproperty float x\n"
                               "element nothing 1000000000000\n"
                               "element face 2\nproperty list uchar int vertex_indices\nproperty float weight\n"
                               "element vertex 3\nproperty double z\nproperty list uchar float extra\n"
                               "property float x\nproperty uchar red\nproperty int32 y\n"
                               "element edge 1\nproperty int a\n"
                               "end_header\n"
                               "99\n"
                               "3 0 1 2 0.5\n0 0.5\n"
                               "3 2 8 9 1 255 2\n\n0.1 0 -4.5 255 5e10\r\n"
                               "0 0 nan 255 0\n"
                               "7";
    (void)state;
    assert_reads("a.ply", text, strlen(text), two_points, 2, 1);
    assert_reads("content decides.xyz", text, strlen(text), two_points, 2, 1);
}

static void put_ply_header(bytes *file, bool big_endian)
{
    put_text(file, big_endian ? "ply\nformat binary_big_endian 1.0\n" : "ply\nformat binary_little_endian 1.0\n");
    put_text(file, "element face 1\nproperty list uchar int vertex_indices\n"
                   "element vertex 2\nproperty float x\nproperty list short double more\nproperty double y\n"
                   "property double z\n"
                   "element last 2\nproperty uint a\nproperty list uint8 uint8 b\n"
                   "end_header\n");
}

static void put_ply(bytes *file, bool big_endian)
{
    put_ply_header(file, big_endian);
    put_bits(file, 2, 1, big_endian);
    put_bits(file, 0x0102030405060708, 8, big_endian);
    for (int i = 0; i < 2; i++) {
        put_float(file, (float)two_points[i][0], big_endian);
        put_bits(file, (uint64_t)i, 2, big_endian);
        for (int j = 0; j < i; j++)
            put_double(file, 17, big_endian);
        put_double(file, two_points[i][1], big_endian);
        put_double(file, two_points[i][2], big_endian);
    }
    put_bits(file, 1, 4, big_endian);
    put_bits(file, 0, 1, big_endian);
    put_bits(file, 1, 4, big_endian);
    put_bits(file, 1, 1, big_endian);
    put_bits(file, 255, 1, big_endian);
}

static void ply_binary_is_read_in_both_byte_orders(void **state)
{
    (void)state;
    for (int big_endian = 0; big_endian < 2; big_endian++) {
        bytes file = {.size = 0};
        put_ply(&file, big_endian);
        assert_reads("a.ply", file.data, file.size, two_points, 2, 0);
        assert_refuses_every_beginning("a.ply", &file);
    }
}

/* Coordinates of every type, at the ends of its range. */
static void ply_reads_every_type(void **state)
{
    static const struct {
        const char *name;
        unsigned size;
        uint64_t bits;
        double value;
    } rows[] = {
        {"char", 1, 0x80, -128},
        {"int8", 1, 0x7f, 127},
        {"uchar", 1, 0xff, 255},
        {"uint8", 1, 0, 0},
        {"short", 2, 0x8000, -32768},
        {"int16", 2, 0xffff, -1},
        {"ushort", 2, 0xffff, 65535},
        {"uint16", 2, 0x0102, 258},
        {"int", 4, 0x80000000, -2147483648.0},
        {"int32", 4, 0xfffffffe, -2},
        {"uint", 4, 0xffffffff, 4294967295.0},
        {"uint32", 4, 0x80000000, 2147483648.0},
        {"float", 4, 0x3dcccccd, 0x1.99999ap-4},
        {"float32", 4, 0x00000001, 0x1p-149},
        {"double", 8, 0x3fb999999999999a, 0.1},
        {"float64", 8, 0x7fefffffffffffff, 0x1.fffffffffffffp1023},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        for (int big_endian = 0; big_endian < 2; big_endian++) {
            char header[256];
            bytes file = {.size = 0};
            double expected[1][3] = {{1, rows[i].value, 2}};
            snprintf(header, sizeof header,
                     "ply\r\nformat binary_%s_endian 1.0\r\nelement vertex 1\r\nproperty uchar x\r\n"
                     "property %s y\r\nproperty uchar z\r\nend_header\r\n",
                     big_endian ? "big" : "little", rows[i].name);
            put_text(&file, header);
            put_bits(&file, 1, 1, big_endian);
            put_bits(&file, rows[i].bits, rows[i].size, big_endian);
            put_bits(&file, 2, 1, big_endian);
            assert_reads("a.ply", file.data, file.size, (const double(*)[3])expected, 1, 0);
        }
    }
}

/* Rows without lists are read in blocks, rows with lists one by one. Both give the same points and values. */
static void ply_rows_are_read_alike_in_blocks_and_one_by_one(void **state)
{
    enum { ROWS = 400, WITHOUT_POSITION = 300 };
    octreel_error error;
    cloud clouds[2];
    (void)state;
    for (int list = 0; list < 2; list++) {
        bytes file = {.size = 0};
        put_text(&file, "ply\nformat binary_little_endian 1.0\nelement vertex 400\nproperty float x\n"
                        "property double y\nproperty short z\nproperty uchar red\nproperty uchar green\n"
                        "property uchar blue\n");
        put_text(&file, list ? "property list uchar int none\nend_header\n" : "end_header\n");
        for (int i = 0; i < ROWS; i++) {
            put_float(&file, i == WITHOUT_POSITION ? NAN : (float)i, false);
            put_double(&file, i * 0.1, false);
            put_bits(&file, (uint64_t)-i, 2, false);
            put_bytes(&file, (unsigned char[]){(unsigned char)i, 1, 255, 0}, list ? 4 : 3);
        }
        assert_true(cloud_parse("a.ply", file.data, file.size, &clouds[list], &error));
        assert_int_equal(clouds[list].count, ROWS - 1);
    }
    assert_memory_equal(clouds[0].positions, clouds[1].positions, (ROWS - 1) * sizeof *clouds[0].positions);
    assert_memory_equal(clouds[0].rows, clouds[1].rows, (ROWS - 1) * sizeof *clouds[0].rows);
    assert_memory_equal(clouds[0].values.rows, clouds[1].values.rows, ROWS * sizeof *clouds[0].values.rows);
    assert_int_equal(clouds[0].rows[ROWS - 2], ROWS - 1);
    assert_true(clouds[0].positions[ROWS - 2][2] == 1 - ROWS);
    assert_int_equal(clouds[0].values.rows[ROWS - 1].color[0], (ROWS - 1) % 256);
    assert_false(clouds[0].values.rows[WITHOUT_POSITION].has[POINT_COLOR]);
    cloud_release(&clouds[0]);
    cloud_release(&clouds[1]);
}

/* The data's first byte is a \n that is not part of the header's last line end. */
static void ply_header_may_end_in_carriage_returns_alone(void **state)
{
    static const char text[] = "ply\rformat binary_little_endian 1.0\relement vertex 1\rproperty uchar x\r"
                               "property uchar y\rproperty uchar z\rend_header\r\n\r\x03";
    static const double expected[][3] = {{10, 13, 3}};
    (void)state;
    assert_reads("a.ply", text, strlen(text), expected, 1, 0);
}

#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define ASCII "ply\nformat ascii 1.0\n"

static void invalid_ply_headers_are_refused(void **state)
{
    static const refusal rows[] = {
        {"plyx\n", "a.ply:1: is not a PLY file: its first line is not \"ply\""},
        {"ply 1\n", "a.ply:1: is not a PLY file: its first line is not \"ply\""},
        {"ply\n\n \n", "a.ply:3: the file ends in its header"},
        {"ply\n", "a.ply:1: the file ends in its header"},
        {"ply\nformat ascii 1.1\n", "a.ply:2: '1.1' is not PLY version 1.0"},
        {"ply\nformat text 1.0\n",
         "a.ply:2: 'text' is not a PLY format; the formats are ascii, binary_little_endian and binary_big_endian"},
        {ASCII "format ascii 1.0\n", "a.ply:3: 'ascii' is a second format in this header; a PLY header has only one"},
        {ASCII "faces 3\n", "a.ply:3: 'faces' does not belong in a PLY header"},
        {ASCII "property float x\n", "a.ply:3: a property stands before any element"},
        {ASCII "element vertex -1\n", "a.ply:3: '-1' is not a count of elements"},
        {ASCII "element vertex 18446744073709551616\n", "a.ply:3: '18446744073709551616' is not a count of elements"},
        {ASCII "element vertex\n", "a.ply:3: '' is not a count of elements"},
        {ASCII "element vertex 1\nelement vertex 1\n", "a.ply:4: 'vertex' is already the name of another element"},
        {ASCII "element vertex 1\nproperty half x\n", "a.ply:4: 'half' is not a PLY type"},
        {ASCII "element vertex 1\nproperty float\n", "a.ply:4: a property has no name"},
        {ASCII "element vertex 1\nproperty float x\nproperty int x\n",
         "a.ply:5: 'x' is already the name of another property"},
        {ASCII "element vertex 1\nproperty list uchar float x\n",
         "a.ply:4: 'x' is a list; a coordinate must be a single number"},
        {ASCII "element vertex 1\nproperty list float float n\n",
         "a.ply:4: 'float' is not an integer type for a list's length"},
        {"ply\nelement vertex 1\n" XYZ "end_header\n", "a.ply:6: the header has no format"},
        {ASCII "element face 1\n" XYZ "end_header\n", "a.ply:7: the header has no element \"vertex\""},
        {ASCII "element vertex 1\nproperty float x\nproperty float z\nend_header\n1 2\n",
         "a.ply:6: element \"vertex\" has no property \"y\""},
    };
    (void)state;
    assert_refuses_each("a.ply", rows, sizeof rows / sizeof *rows);
}

static void ply_data_that_does_not_fit_its_header_is_refused(void **state)
{
    static const refusal rows[] = {
        {ASCII "element vertex 0\n" XYZ "end_header\n", "a.ply: holds no points"},
        {ASCII "element vertex 2\n" XYZ "end_header\nnan 1 1\n1 inf 1\n",
         "a.ply: holds no points that can be read: all 2 are without finite coordinates"},
        {ASCII "element vertex 2\n" XYZ "end_header\n1 2 3\n", "a.ply:8: the file ends after 1 of 2 'vertex'"},
        {ASCII "element vertex 18446744073709551615\n" XYZ "end_header\n1 2 3\n",
         "a.ply:8: the file ends after 1 of 18446744073709551615 'vertex'"},
        {ASCII "element vertex 1\n" XYZ "end_header\n1 2\n", "a.ply:8: the line has too few values"},
        {ASCII "element vertex 1\n" XYZ "end_header\n1 2 3 4\n",
         "a.ply:8: '4' is an extra value after the last property of the line"},
        {ASCII "element vertex 1\n" XYZ "end_header\n1 two 3\n", "a.ply:8: 'two' is not a number"},
        {ASCII "element vertex 1\n" XYZ "end_header\n1 2e400 3\n", "a.ply:8: '2e400' is beyond the largest double"},
        {ASCII "element vertex 1\n" XYZ "property list char int n\nend_header\n1 2 3 -1\n",
         "a.ply:9: '-1' is not a valid length of a list"},
        {ASCII "element vertex 1\n" XYZ "property list int int n\nend_header\n1 2 3 4000000000 1\n",
         "a.ply:9: the line has too few values"},
        {ASCII "element face 1\nproperty int a\nelement vertex 1\n" XYZ "end_header\n1 2\n1 2 3\n",
         "a.ply:10: '2' is an extra value after the last property of the line"},
        {ASCII "element vertex 1\n" XYZ "element face 2\nproperty int a\nend_header\n1 2 3\n7 7\n",
         "a.ply:11: the file ends after 1 of 2 'face'"},
        {"ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\n" XYZ "end_header\n123456789012",
         "a.ply:byte 146: the file ends in the middle of row 2 of 18446744073709551615 'vertex'"},
        {"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty list char int n\n" XYZ "end_header\n\xff",
         "a.ply:byte 140: a list has a negative length"},
        {"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty list uint double n\n" XYZ
         "end_header\n\xff\xff\xff\xff 1234567",
         "a.ply:byte 147: the file ends in the middle of row 1 of 1 'vertex'"},
    };
    (void)state;
    assert_refuses_each("a.ply", rows, sizeof rows / sizeof *rows);
}

/* What follows the last vertex is not needed: faces of other writers have numbers too many. Only what is cut off is
 * refused, whatever is missing. */
static void invalid_ply_rows_after_the_last_vertex_are_noted(void **state)
{
    static const char head[] = "1 2 3\n-4.5 5e10 0.1\n";
    static const struct {
        const char *faces, *sentence;
    } rows[] = {
        {"3 0 1 2 255 0 0\n3 0 1 2\n", "12: '255' is an extra value after the last property of the line"},
        {"3 0 1\n3 0 1 2 4\n", "12: the line has too few values"},
        {"3 0 1 2\n-3 0 1 2\n", "13: '-3' is not a valid length of a list"},
        {"3 0 1 2\n3 0 1 2\nso long\n", "14: the file has more lines than its header says"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[512], note[256];
        snprintf(text, sizeof text, "%s%s%s",
                 ASCII "element vertex 2\n" XYZ "element face 2\nproperty list uchar int corners\nend_header\n", head,
                 rows[i].faces);
        snprintf(note, sizeof note, "a.ply:%s; the points before this place were read", rows[i].sentence);
        assert_reads_and_notes("a.ply", text, strlen(text), two_points, 2, 0, note);
    }
}

static void invalid_ply_bytes_after_the_last_vertex_are_noted(void **state)
{
    static const char header[] = "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty double x\n"
                                 "property double y\nproperty double z\nelement face 2\nproperty list char int n\n"
                                 "end_header\n";
    static const char *const faces[] = {"\x00\x00 ", "\xff\x01"};
    static const char *const reasons[] = {"the file has more data than its header says",
                                          "a list has a negative length"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        bytes file = {.size = 0};
        char note[256];
        put_text(&file, header);
        put_bytes(&file, two_points, sizeof two_points);
        snprintf(note, sizeof note, "a.ply:byte %zu: %s; the points before this place were read",
                 file.size + (i ? 0 : 2), reasons[i]);
        put_bytes(&file, faces[i], i ? 2 : 3);
        assert_reads_and_notes("a.ply", file.data, file.size, two_points, 2, 0, note);
    }
}

#undef XYZ
#undef ASCII

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ply_ascii_skips_other_elements_and_lists),
        cmocka_unit_test(ply_binary_is_read_in_both_byte_orders),
        cmocka_unit_test(ply_reads_every_type),
        cmocka_unit_test(ply_rows_are_read_alike_in_blocks_and_one_by_one),
        cmocka_unit_test(ply_header_may_end_in_carriage_returns_alone),
        cmocka_unit_test(invalid_ply_headers_are_refused),
        cmocka_unit_test(ply_data_that_does_not_fit_its_header_is_refused),
        cmocka_unit_test(invalid_ply_rows_after_the_last_vertex_are_noted),
        cmocka_unit_test(invalid_ply_bytes_after_the_last_vertex_are_noted),
    };
    return cmocka_run_group_tests_name("cloud_ply", tests, NULL, NULL);
}
