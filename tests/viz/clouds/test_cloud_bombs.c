/* SPDX-License-Identifier: MIT */
/* test_cloud_bombs.c - reading a hostile cloud takes no more memory than cloud.h states for its file size. */
#include "heap_peak.h"
#include "las_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BYTES = 300000, SPARE = 4096 };

/* A file of BYTES bytes or a little more. */
typedef struct bomb {
    unsigned char *data;
    size_t size;
} bomb;

static void add(bomb *b, const void *data, size_t size)
{
    assert_true(b->size + size <= BYTES + SPARE);
    memcpy(b->data + b->size, data, size);
    b->size += size;
}

static void add_text(bomb *b, const char *text)
{
    add(b, text, strlen(text));
}

/* To the end. */
static void repeat(bomb *b, const char *data, size_t size)
{
    while (b->size < BYTES)
        add(b, data, size);
}

typedef struct text_bomb {
    const char *name, *header, *repeated;
    size_t size; /* that is repeated; 0: of the text */
} text_bomb;

#define PLY "ply\nformat binary_little_endian 1.0\nelement vertex "
#define PLY_XYZ "\nproperty char x\nproperty char y\nproperty char z\n"
#define PCD "VERSION 0.7\nFIELDS x y z\nSIZE 1 1 1\nTYPE U U U\nHEIGHT 1\nWIDTH "
#define MANY "1000000000000"

static const text_bomb texts[] = {
    {"text", "", "0 0 0\n", 0},
    {"text with values", "x y z intensity class r g b\n", "0 0 0 0 0 0 0 0\n", 0},
    {"text with values now and then", "x y z class r g b\n", "0 0 0\n0 0 0 1\n0 0 0 x 1 1 1\n", 0},
    {"text of one line", "", "0", 0},
    {"text of blanks", "", " ", 0},
    {"text of numbers in one line", "", "1 ", 0},
    {"text of names", "", "a,", 0},
    {"text of names that are values", "x y z", " class", 0},
    {"text of empty lines", "", "\n", 0},
    {"text of comments", "", "#\n", 0},
    {"ply", PLY "100000" PLY_XYZ "end_header\n", "\0\0\0", 3},
    {"ply of a lie", PLY MANY PLY_XYZ "end_header\n", "\0\0\0", 3},
    {"ply of colours",
     PLY "49000" PLY_XYZ "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n", "\0\0\0\1\1\1",
     6},
    {"ply of lists", PLY MANY PLY_XYZ "property list uchar double a\nend_header\n", "\0\0\0\0", 4},
    {"ply of long lists", PLY MANY PLY_XYZ "property list uint double a\nend_header\n", "\377", 1},
    {"ply of rows of nothing", "ply\nformat ascii 1.0\nelement a " MANY "\nelement vertex 1" PLY_XYZ "end_header\n",
     "0 0 0\n", 0},
    {"ply of text", "ply\nformat ascii 1.0\nelement vertex " MANY PLY_XYZ "end_header\n", "0 0 0\n", 0},
    {"ply of elements", "ply\nformat ascii 1.0\n", "element a 0\n", 0},
    {"ply of properties", "ply\nformat ascii 1.0\nelement a 1\n", "property char a\n", 0},
    {"pcd", PCD "99000\nDATA binary\n", "\0\0\0", 3},
    {"pcd of a lie", PCD MANY "\nDATA binary\n", "\0\0\0", 3},
    {"pcd of text", PCD MANY "\nDATA ascii\n", "0 0 0\n", 0},
    {"pcd of fields", "VERSION 0.7\nFIELDS x y z", " a", 0},
    {"pcd of a header", "", "# a PCD\n", 0},
};

/* The bytes of memory for each of the file's; prints what it is. */
static double measure(const char *name, const bomb *b)
{
    cloud c;
    octreel_error error = {""};
    heap_peak_begin();
    cloud_parse("bomb", b->data, b->size, &c, &error);
    const double each = (double)heap_peak() / (double)b->size + 1; /* the file itself */
    print_message("%-32s %6.1f bytes a byte; %zu points; %s\n", name, each, c.count, error.text);
    cloud_release(&c);
    return each;
}

static bomb begin(void)
{
    const bomb b = {malloc(BYTES + SPARE), 0};
    assert_non_null(b.data);
    return b;
}

static void text_and_uncompressed_data_take_12_bytes_per_byte(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        const text_bomb *t = &texts[i];
        bomb b = begin();
        add_text(&b, t->header);
        repeat(&b, t->repeated, t->size ? t->size : strlen(t->repeated));
        assert_true(measure(t->name, &b) < 12);
        free(b.data);
    }
}

/* Each second record is withheld, and rows are counted. */
static void las_takes_12_bytes_per_byte(void **state)
{
    (void)state;
    for (unsigned format = 0; format < LAS_FORMATS; format++)
        for (int lie = 0; lie < 2; lie++) {
            las l = two_points_of_format(format < 4 ? 2 : format < 6 ? 3 : 4, format);
            bytes header = {.size = 0};
            unsigned char record[128] = {0};
            bomb b = begin();
            l.count = lie ? UINT32_MAX : (BYTES - 400) / las_record_sizes[format];
            put_header(&header, &l);
            add(&b, header.data, header.size);
            for (unsigned i = 0; b.size < BYTES; i++) {
                record[12] = record[16] = 1; /* the intensity, and what is the class or beside it */
                record[15] = (i & 1) << (format < 6 ? 7 : 2);
                add(&b, record, las_record_sizes[format]);
            }
            assert_true(measure(lie ? "las of a lie" : "las", &b) < 12);
            free(b.data);
        }
}

/* LZF: three zeros, and then again and again 264 bytes that repeat the byte before. */
static void compressed_pcd_takes_800_bytes_per_byte(void **state)
{
    static const unsigned char zeros[] = {2, 0, 0, 0}, run[] = {0xe0, 0xff, 0x00};
    enum { PACKED = 30000, RUNS = PACKED / sizeof run, POINTS = 1 + RUNS * 264 / 3 };
    const uint32_t sizes[] = {sizeof zeros + RUNS * sizeof run, 3 + RUNS * 264};
    bomb b = begin();
    bytes header = {.size = 0};
    char text[200];
    (void)state;
    snprintf(text, sizeof text, PCD "%d\nDATA binary_compressed\n", POINTS);
    put_text(&header, text);
    put_bits(&header, sizes[0], 4, false);
    put_bits(&header, sizes[1], 4, false);
    add(&b, header.data, header.size);
    add(&b, zeros, sizeof zeros);
    for (int i = 0; i < RUNS; i++)
        add(&b, run, sizeof run);
    const double each = measure("pcd, compressed", &b);
    assert_true(each > 700 && each < 800);
    free(b.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_and_uncompressed_data_take_12_bytes_per_byte),
        cmocka_unit_test(las_takes_12_bytes_per_byte),
        cmocka_unit_test(compressed_pcd_takes_800_bytes_per_byte),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
