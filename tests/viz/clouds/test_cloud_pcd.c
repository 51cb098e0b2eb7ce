/* SPDX-License-Identifier: MIT */
/* test_cloud_pcd.c - the PCD reader. */
#include "clouds.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void put_pcd_header(bytes *file, const char *encoding)
{
    put_text(file, "# .PCD v.7 - Point Cloud Data file format\nVERSION .7\nFIELDS rgb x normal z y _\n"
                   "SIZE 4 8 4 8 8 1\nTYPE F F F F F U\nCOUNT 1 1 3 1 1 5\nWIDTH 3\nHEIGHT 1\n"
                   "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA ");
    put_text(file, encoding);
    put_text(file, "\n");
}

static const double pcd_points[3][3] = {{1, 2, 3}, {NAN, NAN, NAN}, {-4.5, 5e10, 0.1}};

static void put_pcd_field(bytes *file, int point, int field)
{
    static const int axes[] = {-1, 0, -1, 2, 1, -1};
    static const unsigned char others[20] = {1, 2, 3};
    static const size_t sizes[] = {4, 8, 12, 8, 8, 5};
    if (axes[field] >= 0)
        put_double(file, pcd_points[point][axes[field]], false);
    else
        put_bytes(file, others, sizes[field]);
}

/* LZF without any compression: runs of up to 32 bytes, each behind its length less one. */
static void put_packed(bytes *file, const bytes *plain)
{
    enum { RUN = 32 };
    put_bits(file, plain->size + (plain->size + RUN - 1) / RUN, 4, false);
    put_bits(file, plain->size, 4, false);
    for (size_t i = 0; i < plain->size; i += RUN) {
        size_t run = plain->size - i < RUN ? plain->size - i : RUN;
        put_bits(file, run - 1, 1, false);
        put_bytes(file, plain->data + i, run);
    }
}

static void put_pcd_compressed(bytes *file)
{
    bytes fields = {.size = 0};
    for (int field = 0; field < 6; field++)
        for (int point = 0; point < 3; point++)
            put_pcd_field(&fields, point, field);
    put_pcd_header(file, "binary_compressed");
    put_packed(file, &fields);
}

static void put_pcd_binary(bytes *file)
{
    put_pcd_header(file, "binary");
    for (int point = 0; point < 3; point++)
        for (int field = 0; field < 6; field++)
            put_pcd_field(file, point, field);
}

static void put_pcd_ascii(bytes *file)
{
    put_pcd_header(file, "ascii");
    put_text(file, "2.3e-38 1 0 0 nan 3 2 0 0 0 0 0\n0 nan 0 0 1 nan nan 0 0 0 0 0\n"
                   "0 -4.5 0 0 1 0.1 5e10 0 0 0 0 0\n");
}

static void pcd_is_read_in_every_encoding(void **state)
{
    static void (*const puts[])(bytes *) = {put_pcd_ascii, put_pcd_binary, put_pcd_compressed};
    (void)state;
    for (size_t i = 0; i < sizeof puts / sizeof *puts; i++) {
        bytes file = {.size = 0};
        puts[i](&file);
        assert_reads("a.pcd", file.data, file.size, two_points, 2, 1);
        assert_reads("content decides.xyz", file.data, file.size, two_points, 2, 1);
    }
}

static void truncated_binary_pcd_is_refused(void **state)
{
    static void (*const puts[])(bytes *) = {put_pcd_binary, put_pcd_compressed};
    (void)state;
    for (size_t i = 0; i < sizeof puts / sizeof *puts; i++) {
        bytes file = {.size = 0};
        puts[i](&file);
        assert_refuses_every_beginning("a.pcd", &file);
    }
}

/* The Point Cloud Library has filled files up to a page, and other writers end the compressed block with a newline. */
static void bytes_after_the_last_pcd_point_are_noted_unless_zero(void **state)
{
    static void (*const puts[])(bytes *) = {put_pcd_binary, put_pcd_compressed};
    (void)state;
    for (size_t i = 0; i < sizeof puts / sizeof *puts; i++) {
        static const unsigned char zeros[100];
        bytes file = {.size = 0};
        char sentence[128];
        puts[i](&file);
        put_bytes(&file, zeros, sizeof zeros);
        assert_reads("a.pcd", file.data, file.size, two_points, 2, 1);
        snprintf(sentence, sizeof sentence,
                 "a.pcd:byte %zu: the file has more data than its header says; the points before this place were read",
                 file.size);
        put_text(&file, "\n");
        assert_reads_and_notes("a.pcd", file.data, file.size, two_points, 2, 1, sentence);
    }
}

static void pcd_reads_every_type(void **state)
{
    static const struct {
        char type;
        unsigned size;
        uint64_t bits;
        double value;
    } rows[] = {
        {'I', 1, 0x80, -128},
        {'U', 1, 0xff, 255},
        {'I', 2, 0xffff, -1},
        {'U', 2, 0xffff, 65535},
        {'I', 4, 0x80000000, -2147483648.0},
        {'U', 4, 0xffffffff, 4294967295.0},
        {'I', 8, 0x8000000000000000, -0x1p63},
        {'I', 8, 0xffffffffffffffff, -1},
        {'U', 8, 0x8000000000000000, 0x1p63},
        {'F', 4, 0x3dcccccd, 0x1.99999ap-4},
        {'F', 8, 0x3fb999999999999a, 0.1},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char header[256];
        bytes file = {.size = 0};
        double expected[1][3] = {{1, 2, rows[i].value}};
        snprintf(header, sizeof header,
                 "VERSION 0.5\r\nFIELDS x y z\r\nSIZE 1 1 %u\r\nTYPE U U %c\r\nPOINTS 1\r\nDATA binary\r\n",
                 rows[i].size, rows[i].type);
        put_text(&file, header);
        put_bits(&file, 0x0201, 2, false);
        put_bits(&file, rows[i].bits, rows[i].size, false);
        assert_reads("a.pcd", file.data, file.size, (const double(*)[3])expected, 1, 0);
    }
}

static void pcd_without_points_counts_width_times_height(void **state)
{
    static const char text[] = "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nWIDTH 1\nHEIGHT 2\nDATA ascii\n"
                               "1 2 3\n-4.5 5e10 0.1";
    (void)state;
    assert_reads("a.pcd", text, strlen(text), two_points, 2, 0);
}

#define FIELDS "FIELDS x y z\n"
#define TYPES FIELDS "SIZE 4 4 4\nTYPE F F F\n"

static void invalid_pcd_headers_are_refused(void **state)
{
    static const refusal rows[] = {
        {"1 2 3\n", "a.pcd:1: '1' does not belong in a PCD header"},
        {"# only this\n", "a.pcd:1: the file ends in its header"},
        {"VERSION 0.8\n", "a.pcd:1: '0.8' is not a supported version of PCD; versions 0.5 to 0.7 are"},
        {"VERSION 0.4\n", "a.pcd:1: '0.4' is not a supported version of PCD; versions 0.5 to 0.7 are"},
        {"VERSION 0.7a\n", "a.pcd:1: '0.7a' is not a supported version of PCD; versions 0.5 to 0.7 are"},
        {"VERSION new\n", "a.pcd:1: 'new' is not a supported version of PCD; versions 0.5 to 0.7 are"},
        {FIELDS "SIZE 4 4 4 4\n", "a.pcd:2: '4' is an extra value: the line must have one value for each field"},
        {FIELDS "COUNT 1 x 1\n", "a.pcd:2: 'x' is not the count of a field; a count is from 1 to 4294967295"},
        {TYPES "WIDTH 4294967296\nHEIGHT 4294967296\nDATA ascii\n",
         "a.pcd:6: WIDTH 4294967296 times HEIGHT 4294967296 is not POINTS 0"},
        {TYPES "WIDTH 3\nHEIGHT 0\nPOINTS 3\nDATA ascii\n", "a.pcd:7: WIDTH 3 times HEIGHT 0 is not POINTS 3"},
        {"FIELDS x y\n", "a.pcd:1: FIELDS has no field \"z\""},
        {"FIELDS x y z x\n", "a.pcd:1: 'x' is already the name of another field"},
        {"SIZE 4 4 4\n", "a.pcd:1: 'SIZE' stands before FIELDS; FIELDS must come first"},
        {FIELDS FIELDS, "a.pcd:2: 'FIELDS' occurs twice"},
        {"SIZE\nTYPE\n" FIELDS "POINTS 1\nDATA binary\n1",
         "a.pcd:1: 'SIZE' stands before FIELDS; FIELDS must come first"},
        {FIELDS "SIZE 4 4\n", "a.pcd:2: has 2 values, but FIELDS names 3 fields"},
        {FIELDS "SIZE 4 4 3\n", "a.pcd:2: '3' is not the size of a field; a size is 1, 2, 4 or 8"},
        {FIELDS "SIZE 4 4 -4\n", "a.pcd:2: '-4' is not the size of a field; a size is 1, 2, 4 or 8"},
        {FIELDS "TYPE F F G\n", "a.pcd:2: 'G' is not the type of a field; a type is I, U or F"},
        {FIELDS "COUNT 1 0 1\n", "a.pcd:2: '0' is not the count of a field; a count is from 1 to 4294967295"},
        {FIELDS "COUNT 1 1 4294967296\n",
         "a.pcd:2: '4294967296' is not the count of a field; a count is from 1 to 4294967295"},
        {FIELDS "POINTS -3\n", "a.pcd:2: '-3' is not a count of points"},
        {FIELDS "DATA binary_packed\n",
         "a.pcd:2: 'binary_packed' is not a kind of PCD data; the kinds are ascii, binary and binary_compressed"},
        {FIELDS "TYPE F F F\nPOINTS 1\nDATA ascii\n", "a.pcd:4: the header has no SIZE"},
        {TYPES "DATA ascii\n", "a.pcd:4: the header has neither WIDTH nor POINTS"},
        {TYPES "WIDTH 3\nHEIGHT 2\nPOINTS 5\nDATA ascii\n", "a.pcd:7: WIDTH 3 times HEIGHT 2 is not POINTS 5"},
        {TYPES "WIDTH 4294967296\nHEIGHT 4294967296\nPOINTS 0\nDATA ascii\n",
         "a.pcd:7: WIDTH 4294967296 times HEIGHT 4294967296 is not POINTS 0"},
        {TYPES "COUNT 1 2 1\nPOINTS 1\nDATA ascii\n", "a.pcd:6: y has a COUNT of 2, which must be 1"},
        {FIELDS "SIZE 4 2 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n", "a.pcd:5: field 2 is a float of 2 bytes, not 4 or 8"},
    };
    (void)state;
    assert_refuses_each("a.pcd", rows, sizeof rows / sizeof *rows);
}

static void pcd_data_that_does_not_fit_its_header_is_refused(void **state)
{
    static const refusal rows[] = {
        {TYPES "POINTS 0\nDATA ascii\n", "a.pcd: holds no points"},
        {TYPES "POINTS 0\nDATA binary\n", "a.pcd: holds no points"},
        {TYPES "POINTS 1\nDATA ascii\nnan nan nan\n",
         "a.pcd: holds no points that can be read: all 1 are without finite coordinates"},
        {TYPES "POINTS 2\nDATA ascii\n1 2 3\n", "a.pcd:6: the file ends after 1 of 2 points"},
        {TYPES "POINTS 1\nDATA ascii\n1 2\n", "a.pcd:6: has 2 values instead of 3"},
        {TYPES "POINTS 1\nDATA ascii\n1 2 3 4\n", "a.pcd:6: has 4 values instead of 3"},
        {TYPES "POINTS 1\nDATA ascii\n1 2 z\n", "a.pcd:6: 'z' is not a number"},
        {TYPES "POINTS 2\nDATA binary\n12345678901234567890123",
         "a.pcd:byte 56: 2 points of 12 bytes each should follow, but the file has only 23 bytes left"},
        {TYPES "POINTS 18446744073709551615\nDATA binary\n123456789012",
         "a.pcd:byte 75: 18446744073709551615 points of 12 bytes each should follow, but the file has only 12 bytes "
         "left"},
        {"FIELDS x y z n\nSIZE 1 1 1 8\nTYPE U U U F\nCOUNT 1 1 1 4294967295\nPOINTS 4294967295\nDATA binary\n123",
         "a.pcd:byte 94: 4294967295 points of 34359738363 bytes each should follow, but the file has only 3 bytes "
         "left"},
        {TYPES "POINTS 2\nDATA binary_compressed\n1234567", "a.pcd:byte 74: the file ends before its compressed data"},
    };
    (void)state;
    assert_refuses_each("a.pcd", rows, sizeof rows / sizeof *rows);
}

static void lines_after_the_last_pcd_point_are_noted(void **state)
{
    static const char text[] = TYPES "POINTS 2\nDATA ascii\n1 2 3\n-4.5 5e10 0.1\n\n4 5 6\n";
    (void)state;
    assert_reads_and_notes(
        "a.pcd", text, strlen(text), two_points, 2, 0,
        "a.pcd:9: the file has more lines than its header says; the points before this place were read");
}

/* A compressed file of single-byte coordinates: the two sizes it announces, then its data. */
static size_t compressed_bytes(bytes *file, uint64_t points, uint64_t packed, uint64_t size, const char *data)
{
    char header[128];
    snprintf(header, sizeof header, FIELDS "SIZE 1 1 1\nTYPE U U U\nPOINTS %llu\nDATA binary_compressed\n",
             (unsigned long long)points);
    file->size = 0;
    put_text(file, header);
    size_t offset = file->size;
    put_bits(file, packed, 4, false);
    put_bits(file, size, 4, false);
    put_text(file, data);
    return offset;
}

static void pcd_reads_the_tightest_compression(void **state)
{
    static double expected[89][3];
    static const char data[] = "\x02\x07\x07\x07\xe0\xff"; /* three sevens, then 264 bytes as the one before */
    bytes file;
    (void)state;
    for (int i = 0; i < 89; i++)
        expected[i][0] = expected[i][1] = expected[i][2] = 7;
    compressed_bytes(&file, 89, 7, 267, data);
    put_bits(&file, 0, 1, false);
    assert_reads("a.pcd", file.data, file.size, (const double(*)[3])expected, 89, 0);
}

static void impossible_pcd_compression_is_refused(void **state)
{
    static const struct {
        uint64_t points, packed, size;
        size_t offset;
        const char *reason;
    } rows[] = {
        {2, 7, 7, 0, "2 points of 3 bytes each should follow, but the compressed data claims to hold 7 bytes"},
        {UINT64_MAX, 7, 6, 0,
         "18446744073709551615 points of 3 bytes each should follow, but the compressed data claims to hold 6 bytes"},
        {2, 8, 6, 8, "8 compressed bytes should follow, but the file has only 7 bytes left"},
        {1000000000, 7, 3000000000, 8, "7 compressed bytes are too few for 3000000000 bytes of points"},
        {2, 0, 6, 8, "0 compressed bytes are too few for 6 bytes of points"},
        {3, 7, 9, 8, "the compressed data is damaged"},
        {1, 7, 3, 8, "the compressed data is damaged"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        bytes file;
        char sentence[256];
        size_t offset = compressed_bytes(&file, rows[i].points, rows[i].packed, rows[i].size,
                                         "\x05"
                                         "123456");
        snprintf(sentence, sizeof sentence, "a.pcd:byte %zu: %s", offset + rows[i].offset, rows[i].reason);
        assert_refuses("a.pcd", file.data, file.size, sentence);
    }
}

#undef FIELDS
#undef TYPES

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pcd_is_read_in_every_encoding),
        cmocka_unit_test(truncated_binary_pcd_is_refused),
        cmocka_unit_test(bytes_after_the_last_pcd_point_are_noted_unless_zero),
        cmocka_unit_test(pcd_reads_every_type),
        cmocka_unit_test(pcd_without_points_counts_width_times_height),
        cmocka_unit_test(invalid_pcd_headers_are_refused),
        cmocka_unit_test(pcd_data_that_does_not_fit_its_header_is_refused),
        cmocka_unit_test(lines_after_the_last_pcd_point_are_noted),
        cmocka_unit_test(pcd_reads_the_tightest_compression),
        cmocka_unit_test(impossible_pcd_compression_is_refused),
    };
    return cmocka_run_group_tests_name("cloud_pcd", tests, NULL, NULL);
}
