/* SPDX-License-Identifier: MIT */
/* test_png_write.c - the bytes of written PNG files, and the files left after a failed write. */
#include "files.h"
#include "images.h"
#include "png_by_hand.h"
#include "temp_folder.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

static const image_text TEXTS[] = {{"octreel:tick", "12"}, {"Comment", ""}, {"octreel:scene", "00ff"}};
enum { TEXT_COUNT = sizeof TEXTS / sizeof TEXTS[0] };

static void write_with_texts(const image *image, const char *path)
{
    octreel_error error = {""};
    if (!image_write_png(image, path, TEXTS, TEXT_COUNT, &error))
        fail_msg("%s", error.text);
}

static void indexed_and_rgb_survive_the_file(void **state)
{
    static const int sizes[][2] = {{1, 1}, {33, 17}, {16384, 1}, {1, 16384}, {300, 200}};
    const char *path = temp_file(*state, "a.png");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        image_twins twins = make_twins(sizes[i][0], sizes[i][1]);
        const image *each[] = {&twins.indexed, &twins.rgb};
        for (int j = 0; j < 2; j++) {
            assert_written(each[j], path);
            image back = assert_read(path);
            image_difference difference = image_compare(&back, &twins.rgb);
            assert_true(image_has_no_difference(&difference));
            image_release(&back);
        }
        release_twins(&twins);
    }
    assert_int_equal(temp_folder_count(*state), 1);
}

/* Every row must say filter 0 and hold the image's own bytes. */
static void assert_plain_rows(const png_chunk *packed, const image *image)
{
    png_bytes rows;
    uLongf size = sizeof rows.data;
    size_t row_size = (size_t)(image->width * image->channels);
    assert_int_equal(uncompress(rows.data, &size, packed->data, packed->size), Z_OK);
    assert_int_equal(size, (row_size + 1) * (size_t)image->height);
    for (size_t y = 0; y < (size_t)image->height; y++) {
        assert_int_equal(rows.data[y * (row_size + 1)], 0);
        assert_memory_equal(rows.data + y * (row_size + 1) + 1, image->pixels + y * row_size, row_size);
    }
    assert_int_equal(packed->data[1] >> 6, 0); /* the stream's note of a fast encoder */
}

static void assert_header(const png_chunk *header, const image *image)
{
    uint8_t kinds[5] = {8, image->channels == 1 ? 3 : 2, 0, 0, 0};
    assert_int_equal(png_u32_at(header->data), image->width);
    assert_int_equal(png_u32_at(header->data + 4), image->height);
    assert_memory_equal(header->data + 8, kinds, 5);
}

static void assert_types(const png_bytes *file, const char *const *types, size_t count)
{
    size_t at = 8;
    for (size_t i = 0; i < count; i++) {
        png_chunk found = png_chunk_at(file, at);
        assert_string_equal(found.type, types[i]);
        at = found.next;
    }
    assert_int_equal(at, file->size);
}

static void indexed_file_holds_only_the_documented_chunks(void **state)
{
    static const char *const types[] = {"IHDR", "PLTE", "tEXt", "tEXt", "tEXt", "IDAT", "IEND"};
    image_twins twins = make_twins(64, 48);
    png_bytes file;
    write_with_texts(&twins.indexed, temp_file(*state, "a.png"));
    png_bytes_load(&file, temp_file(*state, "a.png"));
    assert_types(&file, types, sizeof types / sizeof types[0]);
    png_chunk header = png_chunk_of(&file, "IHDR");
    png_chunk palette = png_chunk_of(&file, "PLTE");
    png_chunk pixels = png_chunk_of(&file, "IDAT");
    assert_header(&header, &twins.indexed);
    assert_int_equal(palette.size, 3 * twins.indexed.palette.count);
    assert_memory_equal(palette.data, twins.indexed.palette.colors, palette.size);
    assert_plain_rows(&pixels, &twins.indexed);
    release_twins(&twins);
}

static void rgb_file_holds_only_the_documented_chunks(void **state)
{
    static const char *const types[] = {"IHDR", "IDAT", "IEND"};
    image_twins twins = make_twins(64, 48);
    png_bytes file;
    assert_written(&twins.rgb, temp_file(*state, "a.png"));
    png_bytes_load(&file, temp_file(*state, "a.png"));
    assert_types(&file, types, sizeof types / sizeof types[0]);
    png_chunk header = png_chunk_of(&file, "IHDR");
    png_chunk pixels = png_chunk_of(&file, "IDAT");
    assert_header(&header, &twins.rgb);
    assert_plain_rows(&pixels, &twins.rgb);
    release_twins(&twins);
}

static void texts_are_stored_plain_in_the_order_given(void **state)
{
    image_twins twins = make_twins(8, 8);
    png_bytes file;
    write_with_texts(&twins.indexed, temp_file(*state, "a.png"));
    png_bytes_load(&file, temp_file(*state, "a.png"));
    png_chunk found = png_chunk_of(&file, "tEXt");
    for (int i = 0; i < TEXT_COUNT; i++) {
        size_t keyword_size = strlen(TEXTS[i].keyword) + 1;
        assert_int_equal(found.size, keyword_size + strlen(TEXTS[i].text));
        assert_memory_equal(found.data, TEXTS[i].keyword, keyword_size);
        assert_memory_equal(found.data + keyword_size, TEXTS[i].text, strlen(TEXTS[i].text));
        found = png_chunk_at(&file, found.next);
    }
    release_twins(&twins);
}

static void same_image_makes_the_same_bytes(void **state)
{
    png_bytes first, second;
    image_twins twins = make_twins(100, 80);
    write_with_texts(&twins.indexed, temp_file(*state, "a.png"));
    png_bytes_load(&first, temp_file(*state, "a.png"));
    write_with_texts(&twins.indexed, temp_file(*state, "b.png"));
    png_bytes_load(&second, temp_file(*state, "b.png"));
    assert_int_equal(first.size, second.size);
    assert_memory_equal(first.data, second.data, first.size);
    release_twins(&twins);
}

static void failed_write_reports_why_and_leaves_no_file(void **state)
{
    temp_folder *folder = *state;
    image_twins small = make_twins(8, 8);
    image_twins large = make_twins(400, 400);
    png_bytes nothing = {.size = 0};
    png_bytes_save(&nothing, 0, temp_file(folder, "file"));
    assert_int_equal(mkdir(temp_file(folder, "blocked.png.part"), 0700), 0);
    assert_int_equal(mkdir(temp_file(folder, "folder.png"), 0700), 0);
    int before = temp_folder_count(folder);
    const struct {
        const char *name;
        const image *image;
        int reason;
    } cases[] = {
        {"missing/a.png", &small.indexed, ENOENT}, {"file/a.png", &small.indexed, ENOTDIR},
        {"blocked.png", &small.indexed, EISDIR},   {"folder.png", &small.indexed, EISDIR},
        {"full.png", &small.indexed, EFBIG},       {"full.png", &large.rgb, EFBIG},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        octreel_error error = {""};
        const char *path = temp_file(folder, cases[i].name);
        limit_file_size(cases[i].reason == EFBIG ? 20 : SIZE_MAX);
        assert_false(image_write_png(cases[i].image, path, NULL, 0, &error));
        limit_file_size(SIZE_MAX);
        assert_sentence(&error, path, strerror(cases[i].reason));
        assert_int_equal(temp_folder_count(folder), before);
    }
    release_twins(&small);
    release_twins(&large);
}

static void full_disk_removes_the_part_and_keeps_the_old_file(void **state)
{
    image_twins twins = make_twins(8, 8);
    octreel_error error;
    for (int files = 0; files < 2; files++) {
        limit_file_size(20);
        assert_false(image_write_png(&twins.rgb, temp_file(*state, "a.png"), NULL, 0, &error));
        limit_file_size(SIZE_MAX);
        assert_int_equal(temp_folder_count(*state), files);
        if (files == 0)
            assert_written(&twins.indexed, temp_file(*state, "a.png"));
    }
    image kept = assert_read(temp_file(*state, "a.png"));
    image_release(&kept);
    release_twins(&twins);
}

static void unwritable_folder_is_named(void **state)
{
    (void)state;
    static const char path[] = "/proc/frame.png"; /* nobody may write there, not even root */
    image_twins twins = make_twins(8, 8);
    octreel_error error = {""};
    assert_false(image_write_png(&twins.indexed, path, NULL, 0, &error));
    assert_sentence(&error, path, "");
    release_twins(&twins);
}

static void stale_part_is_overwritten(void **state)
{
    image_twins twins = make_twins(8, 8);
    png_bytes torn = {.size = 40000};
    png_bytes_save(&torn, torn.size, temp_file(*state, "a.png.part"));
    assert_written(&twins.indexed, temp_file(*state, "a.png"));
    assert_int_equal(temp_folder_count(*state), 1);
    image back = assert_read(temp_file(*state, "a.png"));
    image_release(&back);
    release_twins(&twins);
}

static void keywords_that_png_forbids_are_refused(void **state)
{
    char long_keyword[81] = {0};
    memset(long_keyword, 'k', sizeof long_keyword - 1);
    const image_text refused[] = {{"", "none"}, {" lead", ""}, {"trail ", ""}, {"two\nlines", ""}, {long_keyword, ""}};
    const char *path = temp_file(*state, "a.png");
    image_twins twins = make_twins(8, 8);
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        octreel_error error = {""};
        assert_false(image_write_png(&twins.indexed, path, &refused[i], 1, &error));
        assert_sentence(&error, path, "");
    }
    const image_text longest = {long_keyword + 1, ""};
    octreel_error error;
    assert_int_equal(temp_folder_count(*state), 0);
    assert_true(image_write_png(&twins.indexed, path, &longest, 1, &error));
    release_twins(&twins);
}

static void index_beyond_the_palette_is_refused(void **state)
{
    const char *path = temp_file(*state, "a.png");
    image_twins twins = make_twins(8, 8);
    octreel_error error = {""};
    twins.indexed.pixels[63] = 4;
    assert_false(image_write_png(&twins.indexed, path, NULL, 0, &error));
    assert_sentence(&error, path, "palette");
    static const int counts[] = {0, -1, 257};
    for (int i = 0; i < 3; i++) {
        twins.indexed.palette.count = counts[i];
        assert_false(image_write_png(&twins.indexed, path, NULL, 0, &error));
        assert_sentence(&error, path, "palette");
    }
    assert_int_equal(temp_folder_count(*state), 0);
    twins.indexed.palette.count = 256;
    twins.indexed.pixels[63] = 255;
    assert_written(&twins.indexed, path);
    release_twins(&twins);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, temp_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(indexed_and_rgb_survive_the_file),
        WITH_FOLDER(indexed_file_holds_only_the_documented_chunks),
        WITH_FOLDER(rgb_file_holds_only_the_documented_chunks),
        WITH_FOLDER(texts_are_stored_plain_in_the_order_given),
        WITH_FOLDER(same_image_makes_the_same_bytes),
        WITH_FOLDER(failed_write_reports_why_and_leaves_no_file),
        WITH_FOLDER(full_disk_removes_the_part_and_keeps_the_old_file),
        cmocka_unit_test(unwritable_folder_is_named),
        WITH_FOLDER(stale_part_is_overwritten),
        WITH_FOLDER(keywords_that_png_forbids_are_refused),
        WITH_FOLDER(index_beyond_the_palette_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
