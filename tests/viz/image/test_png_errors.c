/* SPDX-License-Identifier: MIT */
/* test_png_errors.c - damaged, hostile and non-PNG files: each is refused with a sentence. */
#include "images.h"
#include "png_chunks.h"
#include "png_kinds.h"
#include "temp_folder.h"

#include <errno.h>
#include <png.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <zlib.h>

static void assert_unreadable(const char *path, const char *reason)
{
    image image;
    octreel_error error = {""};
    assert_false(image_read_png(path, &image, &error));
    assert_null(image.pixels);
    assert_sentence(&error, path, reason);
}

static void assert_bytes_unreadable(const png_bytes *file, const char *path, const char *reason)
{
    png_bytes_save(file, file->size, path);
    assert_unreadable(path, reason);
}

static void missing_file_and_folder_have_different_errors(void **state)
{
    temp_folder *folder = *state;
    assert_unreadable(temp_file(folder, "missing.png"), strerror(ENOENT));
    assert_unreadable(folder->name, "is not a regular file");
}

static void file_that_is_not_a_png_is_refused(void **state)
{
    png_bytes file = {.size = 0};
    assert_bytes_unreadable(&file, temp_file(*state, "a.png"), "truncated");
    png_bytes_put(&file, "P6 2 2 255\nabcdefghijkl", 23);
    assert_bytes_unreadable(&file, temp_file(*state, "a.png"), "PNG");
}

static void truncation_anywhere_is_an_error(void **state)
{
    const char *path = temp_file(*state, "a.png");
    png_bytes file;
    png_make_kind(&file, (png_kind){PNG_KIND_RGB_ALPHA, 16, true, false});
    for (size_t size = 0; size < file.size; size += 64) {
        png_bytes_save(&file, size, path);
        assert_unreadable(path, "");
    }
    for (size_t size = file.size - 32; size < file.size; size++) {
        png_bytes_save(&file, size, path);
        assert_unreadable(path, "");
    }
}

static void wrong_crc_of_any_chunk_is_an_error(void **state)
{
    const char *path = temp_file(*state, "a.png");
    png_bytes file;
    png_make_kind(&file, (png_kind){PNG_KIND_PALETTE, 8, false, true});
    size_t at = 8;
    while (at < file.size) {
        at = png_chunk_at(&file, at).next;
        file.data[at - 1] ^= 1;
        assert_bytes_unreadable(&file, path, "CRC");
        file.data[at - 1] ^= 1;
    }
}

/* Every byte has a CRC; the stream's own Adler-32 is not asked as well, where libpng can be told so. */
static void stream_with_a_wrong_adler32_is_read(void **state)
{
    const char *path = temp_file(*state, "a.png");
    static const uint8_t rows[] = {0, 10, 20, 30, 0, 40, 50, 60};
    uint8_t packed[64];
    uLongf size = sizeof packed;
    png_bytes file;
    assert_int_equal(compress(packed, &size, rows, sizeof rows), Z_OK);
    packed[size - 1] ^= 1;
    png_put_header(&file, 3, 2, 8, PNG_KIND_GREY, false);
    png_put_chunk(&file, "IDAT", packed, size);
    png_put_chunk(&file, "IEND", NULL, 0);
    png_bytes_save(&file, file.size, path);
#ifdef PNG_IGNORE_ADLER32
    image image = assert_read(path);
    assert_memory_equal(image.pixels, ((uint8_t[]){10, 20, 30, 40, 50, 60}), 6);
    image_release(&image);
#else
    assert_unreadable(path, "");
#endif
}

static void any_flipped_bit_is_an_error(void **state)
{
    const char *path = temp_file(*state, "a.png");
    png_bytes file;
    png_make_kind(&file, (png_kind){PNG_KIND_PALETTE, 2, false, true});
    for (size_t i = 0; i < file.size; i++) {
        file.data[i] ^= (uint8_t)(1 << i % 8);
        assert_bytes_unreadable(&file, path, "");
        file.data[i] ^= (uint8_t)(1 << i % 8);
    }
}

static void huge_sides_are_refused_before_memory_is_spent(void **state)
{
    static const uint32_t sizes[][2] = {{100000, 100000}, {16385, 1},
                                        {1, 16385},       {2000000, 1},
                                        {0x7fffffff, 1},  {0x7fffffff, 0x7fffffff},
                                        {0, 1},           {0xffffffff, 0xffffffff}};
    const char *path = temp_file(*state, "a.png");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        png_bytes file, rows = {.size = 100};
        png_put_header(&file, sizes[i][0], sizes[i][1], 8, PNG_KIND_GREY, true);
        png_put_rows_and_end(&file, &rows);
        assert_bytes_unreadable(&file, path, i < 5 ? "side" : "");
    }
}

/* A picture that this program may read, in a file of a few bytes. */
static void more_pixels_than_the_file_can_hold_are_refused(void **state)
{
    static const int types[] = {PNG_KIND_GREY, PNG_KIND_RGB, PNG_KIND_GREY_ALPHA, PNG_KIND_RGB_ALPHA};
    const char *path = temp_file(*state, "a.png");
    for (size_t i = 0; i < 4; i++) {
        png_bytes file, rows = {.size = 100};
        struct rusage before, after;
        png_put_header(&file, 16384, 16384, 16, types[i], i % 2 == 1);
        png_put_rows_and_end(&file, &rows);
        assert_int_equal(getrusage(RUSAGE_SELF, &before), 0);
        assert_bytes_unreadable(&file, path, "more pixels than it can hold");
        assert_int_equal(getrusage(RUSAGE_SELF, &after), 0);
        assert_true(after.ru_maxrss - before.ru_maxrss < 20000); /* kilobytes */
    }
}

static void pipe_is_refused_without_waiting(void **state)
{
    const char *path = temp_file(*state, "pipe");
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_unreadable(path, "not a regular file");
}

static void too_few_pixels_are_an_error(void **state)
{
    png_bytes file, rows = {.data = {0}, .size = 4 * 5 - 1};
    png_put_header(&file, 4, 4, 8, PNG_KIND_GREY, false);
    png_put_rows_and_end(&file, &rows);
    assert_bytes_unreadable(&file, temp_file(*state, "a.png"), "");
}

static void index_beyond_the_palette_is_an_error(void **state)
{
    const char *path = temp_file(*state, "a.png");
    for (int interlaced = 0; interlaced < 2; interlaced++) {
        /* Row by row: filter 0, index 1, index 2. Adam7 has the two pixels in passes of their own. */
        static const uint8_t rows_of[2][4] = {{0, 1, 2}, {0, 1, 0, 2}};
        png_bytes file, rows = {.size = 0};
        png_bytes_put(&rows, rows_of[interlaced], interlaced ? 4 : 3);
        png_put_header(&file, 2, 1, 8, PNG_KIND_PALETTE, interlaced);
        png_put_chunk(&file, "PLTE", "abcdef", 6);
        png_put_rows_and_end(&file, &rows);
        assert_bytes_unreadable(&file, path, "palette");
    }
}

static void illegal_headers_are_refused(void **state)
{
    static const int stored[][2] = {{PNG_KIND_RGB, 4},       {PNG_KIND_PALETTE, 16}, {PNG_KIND_GREY, 3}, {1, 8}, {7, 8},
                                    {PNG_KIND_GREY_ALPHA, 1}};
    png_bytes file, rows = {.data = {0}, .size = 100};
    for (size_t i = 0; i < sizeof stored / sizeof stored[0]; i++) {
        png_put_header(&file, 4, 4, stored[i][1], stored[i][0], false);
        png_put_rows_and_end(&file, &rows);
        assert_bytes_unreadable(&file, temp_file(*state, "a.png"), "");
    }
}

static void palette_file_without_palette_is_refused(void **state)
{
    png_bytes file, rows = {.data = {0}, .size = 20};
    png_put_header(&file, 4, 4, 8, PNG_KIND_PALETTE, false);
    png_put_rows_and_end(&file, &rows);
    assert_bytes_unreadable(&file, temp_file(*state, "a.png"), "PLTE");
}

static void overlong_path_still_gets_its_reason(void **state)
{
    (void)state;
    char path[2000];
    memset(path, 'x', sizeof path - 1);
    path[sizeof path - 1] = '\0';
    image image;
    octreel_error error = {""};
    assert_false(image_read_png(path, &image, &error));
    assert_non_null(strstr(error.text, strerror(ENAMETOOLONG)));
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, temp_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(more_pixels_than_the_file_can_hold_are_refused),
        WITH_FOLDER(pipe_is_refused_without_waiting),
        WITH_FOLDER(missing_file_and_folder_have_different_errors),
        WITH_FOLDER(file_that_is_not_a_png_is_refused),
        WITH_FOLDER(truncation_anywhere_is_an_error),
        WITH_FOLDER(wrong_crc_of_any_chunk_is_an_error),
        WITH_FOLDER(stream_with_a_wrong_adler32_is_read),
        WITH_FOLDER(any_flipped_bit_is_an_error),
        WITH_FOLDER(huge_sides_are_refused_before_memory_is_spent),
        WITH_FOLDER(too_few_pixels_are_an_error),
        WITH_FOLDER(index_beyond_the_palette_is_an_error),
        WITH_FOLDER(illegal_headers_are_refused),
        WITH_FOLDER(palette_file_without_palette_is_refused),
        cmocka_unit_test(overlong_path_still_gets_its_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
