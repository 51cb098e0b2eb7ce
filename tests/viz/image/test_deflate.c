/* SPDX-License-Identifier: MIT */
/* test_deflate.c - compression of rows: zlib decodes the streams, and they are smaller than its own for drawings. */
#include "deflate.h"
#include "deflate_block.h"
#include "octree/digest.h"
#include "octree/sample.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
#include <zlib.h>

/* Rows as they are in a PNG: each begins with a zero. */
typedef struct rows {
    uint8_t *bytes;
    size_t size, count, pixel; /* of a row; of rows; bytes a pixel */
} rows;

typedef struct stream {
    uint8_t *bytes;
    size_t size, room, largest_part;
} stream;

static void *allocate(size_t size)
{
    void *memory = calloc(size, 1);
    assert_non_null(memory);
    return memory;
}

static rows make_rows(size_t width, size_t height, size_t pixel)
{
    return (rows){allocate((width * pixel + 1) * height), width * pixel + 1, height, pixel};
}

static uint8_t *at_pixel(const rows *r, size_t x, size_t y)
{
    return r->bytes + y * r->size + 1 + x * r->pixel;
}

static void set_pixel(const rows *r, size_t x, size_t y, unsigned color)
{
    for (size_t i = 0; i < r->pixel; i++)
        at_pixel(r, x, y)[i] = (uint8_t)(color * (2 * i + 1));
}

static void take_part(void *context, const uint8_t *bytes, size_t size)
{
    stream *s = context;
    assert_true(size > 0 && s->size + size <= s->room);
    memcpy(s->bytes + s->size, bytes, size);
    s->size += size;
    s->largest_part = size > s->largest_part ? size : s->largest_part;
}

static stream encode(const rows *r)
{
    stream s = {.room = r->size * r->count * 2 + 1000};
    s.bytes = allocate(s.room);
    deflater *d = deflater_open(r->size, r->count, r->pixel, take_part, &s);
    assert_non_null(d);
    for (size_t y = 0; y < r->count; y++)
        deflater_add_row(d, r->bytes + y * r->size + 1);
    deflater_finish(d);
    deflater_close(d);
    return s;
}

/* Undo PNG's filter Sub in the rows that have it. Returns the number of these rows. */
static size_t undo_filter(const rows *r, uint8_t *bytes)
{
    size_t filtered = 0;
    for (uint8_t *row = bytes; row < bytes + r->size * r->count; row += r->size) {
        assert_in_range(row[0], 0, r->pixel > 1);
        for (size_t i = 1 + r->pixel; row[0] && i < r->size; i++)
            row[i] = (uint8_t)(row[i] + row[i - r->pixel]);
        filtered += row[0];
        row[0] = 0;
    }
    return filtered;
}

/* Assert that zlib decodes a stream into the rows. Returns the number of filtered rows. */
static size_t assert_inflates(const rows *r, const stream *s)
{
    uLongf size = r->size * r->count;
    uint8_t *back = allocate(size + 1);
    z_stream z = {.next_in = s->bytes, .avail_in = (uInt)s->size, .next_out = back, .avail_out = (uInt)size + 1};
    assert_int_equal(inflateInit(&z), Z_OK);
    assert_int_equal(inflate(&z, Z_FINISH), Z_STREAM_END);
    assert_int_equal(z.total_out, size);
    assert_int_equal(z.avail_in, 0);
    const size_t filtered = undo_filter(r, back);
    assert_memory_equal(back, r->bytes, size);
    inflateEnd(&z);
    free(back);
    return filtered;
}

/* ---- Pictures ------------------------------------------------------------------------------------------------ */

typedef void fill_rows(const rows *r, uint64_t *random);

static size_t width_of(const rows *r)
{
    return (r->size - 1) / r->pixel;
}

static void fill_noise(const rows *r, uint64_t *random)
{
    for (size_t y = 0; y < r->count; y++)
        for (size_t x = 1; x < r->size; x++)
            r->bytes[y * r->size + x] = (uint8_t)octree_random(random);
}

static void fill_few_colors(const rows *r, uint64_t *random)
{
    for (size_t y = 0; y < r->count; y++)
        for (size_t x = 0; x < width_of(r); x++)
            set_pixel(r, x, y, octree_random(random) % 3);
}

/* Runs of all lengths, in rows that often are the one above but for a piece. */
static void fill_runs(const rows *r, uint64_t *random)
{
    for (size_t y = 0; y < r->count; y++) {
        if (y > 0)
            memcpy(at_pixel(r, 0, y), at_pixel(r, 0, y - 1), r->size - 1);
        if (y > 0 && octree_random(random) % 4 == 0)
            continue;
        size_t x = y == 0 ? 0 : octree_random(random) % width_of(r);
        const size_t end = y == 0 ? width_of(r) : x + octree_random(random) % (width_of(r) - x + 1);
        while (x < end) {
            const unsigned color = octree_random(random) % 256;
            for (size_t n = 1 + (octree_random(random) & (octree_random(random) & 511)); n > 0 && x < end; n--)
                set_pixel(r, x++, y, color);
        }
    }
}

/* Lines in all directions on one ground, as boxes of an octree are drawn. */
static void fill_lines(const rows *r, uint64_t *random)
{
    const size_t width = width_of(r);
    for (size_t line = 0; line < 40; line++) {
        const int64_t from = (int64_t)(octree_random(random) % width), to = (int64_t)(octree_random(random) % width);
        const int64_t height = (int64_t)r->count, first = (int64_t)(octree_random(random) % r->count);
        for (int64_t y = first; y < height; y++)
            set_pixel(r, (size_t)(from + (to - from) * (y - first) / height), (size_t)y, 1 + (unsigned)line % 9);
        if (line % 3 == 0)
            for (int64_t x = from < to ? from : to; x < (from < to ? to : from); x++)
                set_pixel(r, (size_t)x, (size_t)first, 3);
    }
}

/* A shaded surface: in each channel a smooth change with some noise. */
static void fill_surface(const rows *r, uint64_t *random)
{
    for (size_t y = 0; y < r->count; y++)
        for (size_t x = 0; x < r->size - 1; x++)
            r->bytes[y * r->size + 1 + x] =
                (uint8_t)(x / r->pixel * (1 + x % r->pixel) / 2 + y + octree_random(random) % 8);
}

static void fill_nothing(const rows *r, uint64_t *random)
{
    (void)r;
    (void)random;
}

static fill_rows *const fillings[] = {fill_noise, fill_few_colors, fill_runs, fill_lines, fill_nothing, fill_surface};
enum { FILLINGS = sizeof fillings / sizeof fillings[0] };

/* ---- Tests --------------------------------------------------------------------------------------------------- */

static void zlib_decodes_rows_of_all_kinds(void **state)
{
    (void)state;
    static const size_t sizes[][2] = {{1, 1},    {1, 2},     {2, 1},     {1, 700},   {3, 5},     {7, 300},  {8, 9},
                                      {255, 40}, {258, 3},   {259, 9},   {300, 257}, {1280, 90}, {2, 400},  {520, 2},
                                      {31, 31},  {10922, 5}, {32767, 4}, {32768, 4}, {40000, 3}, {16384, 9}};
    uint64_t random = 1;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (size_t filling = 0; filling < FILLINGS; filling++)
            for (size_t pixel = 1; pixel <= 3; pixel += 2) {
                const rows r = make_rows(sizes[i][0], sizes[i][1], pixel);
                fillings[filling](&r, &random);
                stream s = encode(&r);
                assert_inflates(&r, &s);
                free(s.bytes);
                free(r.bytes);
            }
}

static size_t zlib_size(const rows *r)
{
    static uint8_t packed[4 << 20];
    z_stream z = {
        .next_in = r->bytes, .avail_in = (uInt)(r->size * r->count), .next_out = packed, .avail_out = sizeof packed};
    const int strategy = r->pixel == 1 ? Z_RLE : Z_DEFAULT_STRATEGY;
    assert_int_equal(deflateInit2(&z, 1, Z_DEFLATED, 15, 8, strategy), Z_OK);
    assert_int_equal(deflate(&z, Z_FINISH), Z_STREAM_END);
    deflateEnd(&z);
    return z.total_out;
}

static void drawn_pictures_are_smaller_than_by_zlib(void **state)
{
    (void)state;
    static fill_rows *const drawn[] = {fill_lines, fill_runs};
    uint64_t random = 7;
    for (size_t i = 0; i < 2; i++)
        for (size_t pixel = 1; pixel <= 3; pixel += 2) {
            const rows r = make_rows(640, 360, pixel);
            drawn[i](&r, &random);
            stream s = encode(&r);
            assert_true(s.size < zlib_size(&r) * 9 / 10);
            free(s.bytes);
            free(r.bytes);
        }
}

static void surfaces_are_filtered_and_lines_are_not(void **state)
{
    (void)state;
    uint64_t random = 9;
    const rows r = make_rows(640, 360, 3);
    for (int surface = 0; surface < 2; surface++) {
        (surface ? fill_surface : fill_lines)(&r, &random);
        stream s = encode(&r);
        const size_t filtered = assert_inflates(&r, &s);
        assert_true(surface ? filtered > r.count * 9 / 10 : filtered == 0);
        assert_true(s.size < zlib_size(&r) * 2 / 3);
        free(s.bytes);
    }
    free(r.bytes);
}

static void noise_grows_little_and_reaches_the_sink_in_parts(void **state)
{
    (void)state;
    uint64_t random = 3;
    const rows r = make_rows(700, 500, 1);
    fill_noise(&r, &random);
    stream s = encode(&r);
    assert_true(s.size < r.size * r.count + r.size * r.count / 500);
    assert_true(s.largest_part >= 1 && s.largest_part <= 1 << 16);
    free(s.bytes);
    free(r.bytes);
}

/* A row that repeats the one above it is cheaper where it is one colour: a distance of one pixel takes no more bits. */
static void flat_repeats_are_coded_as_runs(void **state)
{
    (void)state;
    enum { WIDTH = 1280, HEIGHT = 720 };
    for (size_t pixel = 1; pixel <= 3; pixel += 2) {
        const rows r = make_rows(WIDTH, HEIGHT, pixel);
        for (size_t y = 0; y < r.count; y++)
            set_pixel(&r, WIDTH / 2, y, 1);
        stream s = encode(&r);
        assert_inflates(&r, &s);
        assert_true(s.size < r.size * r.count / 450);
        free(s.bytes);
        free(r.bytes);
    }
}

/* As RFC 1951 counts them: as they are, in the fixed code, in one of their own. */
static void each_block_uses_its_shortest_code(void **state)
{
    (void)state;
    static const struct {
        size_t width, height;
        fill_rows *fill;
        int kind;
    } cases[] = {{400, 400, fill_noise, 0}, {4, 4, fill_lines, 1}, {400, 400, fill_lines, 2}};
    uint64_t random = 5;
    for (size_t i = 0; i < 3; i++) {
        const rows r = make_rows(cases[i].width, cases[i].height, 1);
        cases[i].fill(&r, &random);
        stream s = encode(&r);
        assert_int_equal(s.bytes[2] >> 1 & 3, cases[i].kind);
        free(s.bytes);
        free(r.bytes);
    }
}

/* A frame has the same bytes wherever it is written. */
static void compressed_streams_have_pinned_digests(void **state)
{
    (void)state;
    static const uint64_t pinned[FILLINGS][2] = {{UINT64_C(0x575e84a3a45d7680), UINT64_C(0x7907ef51868f6355)},
                                                 {UINT64_C(0xe3bff28a3b5c4cb4), UINT64_C(0xf135795c37c1aa88)},
                                                 {UINT64_C(0x02cfa7345c53203c), UINT64_C(0x2d434374a6eb91b1)},
                                                 {UINT64_C(0x229c958048db612d), UINT64_C(0x5a928bb6a80bb7e1)},
                                                 {UINT64_C(0x7b6b76f2e2a3c290), UINT64_C(0xdee833b855afe3db)},
                                                 {UINT64_C(0xb2c00382bf6800af), UINT64_C(0xa81b007f68279381)}};
    for (size_t filling = 0; filling < FILLINGS; filling++)
        for (size_t n = 0; n < 2; n++) {
            uint64_t random = 11;
            const rows r = make_rows(333, 444, 1 + 2 * n);
            fillings[filling](&r, &random);
            stream s = encode(&r);
            const uint64_t digest = octree_digest_bytes(OCTREE_DIGEST_START, s.bytes, s.size);
            assert_true(digest == pinned[filling][n]);
            free(s.bytes);
            free(r.bytes);
        }
}

/* Counts like Fibonacci's numbers make the longest codes of all. */
static void codes_are_complete_and_within_the_limit(void **state)
{
    (void)state;
    enum { SYMBOLS = 24 };
    uint32_t counts[SYMBOLS] = {1, 1};
    for (size_t i = 2; i < SYMBOLS; i++)
        counts[i] = counts[i - 1] + counts[i - 2];
    for (size_t used = 0; used <= SYMBOLS; used++)
        for (int longest = 5; longest <= HUFFMAN_LONGEST; longest++) {
            huffman_code code;
            uint32_t some[SYMBOLS] = {0}, space = 0;
            memcpy(some, counts, used * sizeof *some);
            huffman_build_code(&code, some, SYMBOLS, longest);
            for (size_t i = 0; i < SYMBOLS; i++) {
                assert_true(code.lengths[i] >= (some[i] > 0) && code.lengths[i] <= longest);
                space += code.lengths[i] ? 1u << (longest - code.lengths[i]) : 0;
                if (i > 0 && i < used)
                    assert_true(code.lengths[i] <= code.lengths[i - 1]);
            }
            assert_int_equal(space, 1u << longest);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(zlib_decodes_rows_of_all_kinds),
        cmocka_unit_test(drawn_pictures_are_smaller_than_by_zlib),
        cmocka_unit_test(surfaces_are_filtered_and_lines_are_not),
        cmocka_unit_test(noise_grows_little_and_reaches_the_sink_in_parts),
        cmocka_unit_test(flat_repeats_are_coded_as_runs),
        cmocka_unit_test(each_block_uses_its_shortest_code),
        cmocka_unit_test(compressed_streams_have_pinned_digests),
        cmocka_unit_test(codes_are_complete_and_within_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
