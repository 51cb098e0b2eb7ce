/* SPDX-License-Identifier: MIT */
/* test_png_bombs.c - reading a hostile PNG takes no more memory than png_read.h states for its file size. */
#include "fixture.h"
#include "heap_peak.h"
#include "png_by_hand.h"
#include "png_read.h"
#include "temp_folder.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { MOST_BYTES_A_BYTE = 8300, BESIDE = 400000, LARGEST_CHUNK = 8000000 };

static octreel_error error;

/* The most memory of reading it whole. */
static size_t peak_of(const char *path, bool *read)
{
    image whole;
    error.text[0] = 0;
    heap_peak_begin();
    *read = image_read_png(path, &whole, &error);
    const size_t peak = heap_peak();
    image_release(&whole);
    return peak;
}

/* The same row by row. */
static size_t peak_of_rows(const char *path)
{
    image band;
    error.text[0] = 0;
    heap_peak_begin();
    image_source *source = image_source_open(path, IMAGE_WHITE, false, &error);
    while (source && image_source_read_band(source, 16, &band))
        ;
    const size_t peak = heap_peak();
    image_source_close(source);
    return peak;
}

/* So many zeros as a zlib stream. */
static void put_zeros(png_bytes *out, const char *type, const char *before, size_t before_size, size_t count)
{
    static uint8_t packed[sizeof out->data];
    uLongf size = sizeof packed - before_size;
    uint8_t *zeros = calloc(count, 1);
    assert_non_null(zeros);
    memcpy(packed, before, before_size);
    assert_int_equal(compress2(packed + before_size, &size, zeros, count, 9), Z_OK);
    free(zeros);
    png_put_chunk(out, type, packed, before_size + size);
}

static void put_palette(png_bytes *out)
{
    static const uint8_t colors[3 * 2];
    png_put_chunk(out, "PLTE", colors, sizeof colors);
}

typedef struct kind {
    int type, depth, bits; /* of a pixel */
} kind;

static const kind kinds[] = {{0, 1, 1}, {0, 8, 8},  {0, 16, 16}, {2, 8, 24}, {2, 16, 48}, {3, 1, 1},
                             {3, 8, 8}, {4, 8, 16}, {4, 16, 32}, {6, 8, 32}, {6, 16, 64}};

enum { KINDS = sizeof kinds / sizeof kinds[0], WIDTH = 4096 };

static void begin(png_bytes *out, const kind *k, uint32_t width, uint32_t height, bool interlaced)
{
    out->size = 0;
    png_put_header(out, width, height, k->depth, k->type, interlaced);
    if (k->type == 3)
        put_palette(out);
}

/* Zeros, a thousand for each byte. */
static void reading_takes_at_most_8300_bytes_per_byte_of_file(void **state)
{
    const char *path = temp_file(*state, "a.png");
    static png_bytes file;
    bool read;
    for (size_t i = 0; i < 2 * KINDS; i++) {
        const kind *k = &kinds[i / 2];
        const uint32_t rows = k->bits == 1 ? 2048 : 256;
        const size_t row = (size_t)WIDTH * (size_t)k->bits / 8 + 1;
        begin(&file, k, WIDTH, rows, i % 2);
        put_zeros(&file, "IDAT", "", 0, row * rows + i % 2 * 8 * rows); /* passes have more rows */
        png_put_chunk(&file, "IEND", NULL, 0);
        png_bytes_save(&file, file.size, path);
        const size_t peak = peak_of(path, &read), by_rows = peak_of_rows(path);
        print_message("type %d, %2d bits%s: %5zu bytes a byte, row by row %5zu; %s\n", k->type, k->depth,
                      i % 2 ? ", interlaced" : "", peak / file.size, by_rows / file.size, error.text);
        assert_true(peak < MOST_BYTES_A_BYTE * file.size && peak <= (size_t)WIDTH * rows * 8 + BESIDE);
        assert_true(i % 2 || k->depth == 16 || by_rows < BESIDE + 64 * row * 8);
    }
}

static void assert_cheap(const png_bytes *file, const char *path, size_t most, const char *reason)
{
    bool read;
    png_bytes_save(file, file->size, path);
    const size_t peak = peak_of(path, &read);
    print_message("%zu bytes: %zu; %s\n", file->size, peak, error.text);
    assert_true(peak < most);
    assert_true(read == (reason == NULL));
    if (reason && !strstr(error.text, reason))
        fail_msg("%s", error.text);
}

static void sizes_that_a_file_cannot_hold_are_refused(void **state)
{
    static const uint32_t sides[][2] = {
        {100000, 100000}, {16384, 16384}, {0x7fffffff, 0x7fffffff}, {0x7fffffff, 1}, {1, 100000}};
    const char *path = temp_file(*state, "a.png");
    static png_bytes file;
    for (size_t i = 0; i < sizeof sides / sizeof sides[0] * KINDS; i++) {
        const uint32_t *side = sides[i / KINDS];
        begin(&file, &kinds[i % KINDS], side[0], side[1], i & 1);
        put_zeros(&file, "IDAT", "", 0, 1000);
        png_put_chunk(&file, "IEND", NULL, 0);
        assert_cheap(&file, path, 20000, side[0] == 16384 ? "claims more pixels than it can hold" : "");
    }
}

/* Twenty million bytes each. */
static void chunks_that_unpack_to_much_are_not_unpacked(void **state)
{
    static const struct {
        const char *type, *before;
        size_t size;
    } rows[] = {{"zTXt", "Comment\0", 9}, {"iTXt", "Comment\0\1\0\0", 12}, {"iCCP", "profile\0", 9}};
    const char *path = temp_file(*state, "a.png");
    static png_bytes file;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        begin(&file, &kinds[1], 8, 8, false);
        put_zeros(&file, rows[i].type, rows[i].before, rows[i].size, 20000000);
        put_zeros(&file, "IDAT", "", 0, 72);
        png_put_chunk(&file, "IEND", NULL, 0);
        assert_cheap(&file, path, BESIDE, NULL);
    }
}

static void data_beyond_the_last_row_takes_no_memory(void **state)
{
    static png_bytes file;
    begin(&file, &kinds[1], 8, 8, false);
    put_zeros(&file, "IDAT", "", 0, 20000000);
    png_put_chunk(&file, "IEND", NULL, 0);
    assert_cheap(&file, temp_file(*state, "a.png"), BESIDE, "");
}

/* The length of a chunk is believed up to a limit, before its data is there. */
static void claimed_chunk_sizes_take_at_most_one_chunk(void **state)
{
    static const char *const types[] = {"iCCP", "zTXt", "tEXt", "IDAT", "PLTE", "tRNS", "eXIf", "sPLT", "gAMA"};
    static const uint8_t lengths[][4] = {{0x00, 0x7a, 0x12, 0x00}, {0x7f, 0xff, 0xff, 0xff}};
    static png_bytes file;
    for (size_t i = 0; i < 2 * sizeof types / sizeof types[0]; i++) {
        begin(&file, &kinds[6], 8, 8, false);
        png_bytes_put(&file, lengths[i % 2], 4);
        png_bytes_put(&file, types[i / 2], 4);
        png_bytes_put(&file, "abcdefgh", 8);
        assert_cheap(&file, temp_file(*state, "a.png"), LARGEST_CHUNK + BESIDE, "");
    }
}

/* More than a thousand are refused. */
static void many_chunks_take_memory_by_their_size(void **state)
{
    static png_bytes file;
    begin(&file, &kinds[1], 8, 8, false);
    while (file.size < sizeof file.data - 200)
        png_put_chunk(&file, "cHRM", "", 0);
    put_zeros(&file, "IDAT", "", 0, 72);
    png_put_chunk(&file, "IEND", NULL, 0);
    assert_cheap(&file, temp_file(*state, "a.png"), BESIDE, "no space in chunk cache");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, temp_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(reading_takes_at_most_8300_bytes_per_byte_of_file), TEST(sizes_that_a_file_cannot_hold_are_refused),
        TEST(chunks_that_unpack_to_much_are_not_unpacked),       TEST(data_beyond_the_last_row_takes_no_memory),
        TEST(claimed_chunk_sizes_take_at_most_one_chunk),        TEST(many_chunks_take_memory_by_their_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
