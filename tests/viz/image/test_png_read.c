/* SPDX-License-Identifier: MIT */
/* test_png_read.c - PNG files of every legal kind to pixels, without loss. */
#include "images.h"
#include "naive_compare.h"
#include "png_chunks.h"
#include "png_kinds.h"
#include "temp_folder.h"

#include <math.h>
#include <string.h>

static double alpha_of(png_kind kind, int x, int y)
{
    int samples = png_samples_per_pixel(kind.color_type);
    if (kind.color_type == PNG_KIND_GREY_ALPHA || kind.color_type == PNG_KIND_RGB_ALPHA)
        return (double)png_sample_at(kind, x, y, samples - 1) / png_largest_sample(kind);
    if (!kind.keyed)
        return 1;
    if (kind.color_type == PNG_KIND_PALETTE)
        return png_palette_alpha(png_sample_at(kind, x, y, 0)) / 255.0;
    for (int i = 0; i < samples; i++) {
        if (png_sample_at(kind, x, y, i) != png_sample_at(kind, 3, 0, i))
            return 1;
    }
    return 0;
}

/* What a channel must be, 0 to 1. */
static double expected_channel(png_kind kind, int x, int y, int channel, const double ground[3])
{
    double alpha = alpha_of(kind, x, y);
    double value;
    if (kind.color_type == PNG_KIND_PALETTE) {
        image_color color = png_palette_color(png_sample_at(kind, x, y, 0));
        value = (channel == 0 ? color.r : channel == 1 ? color.g : color.b) / 255.0;
    } else {
        bool grey = kind.color_type == PNG_KIND_GREY || kind.color_type == PNG_KIND_GREY_ALPHA;
        value = (double)png_sample_at(kind, x, y, grey ? 0 : channel) / png_largest_sample(kind);
    }
    return value * alpha + ground[channel] * (1 - alpha);
}

/* As near as the image's samples can be: opaque pixels exactly, of whatever depth. */
static void assert_decoded(const image *image, png_kind kind, const double ground[3])
{
    assert_true(image->width == PNG_KIND_SIDE && image->height == PNG_KIND_SIDE);
    assert_int_equal(image->wide, kind.depth == 16);
    assert_int_equal(image->channels,
                     kind.color_type == PNG_KIND_PALETTE || (kind.color_type == PNG_KIND_GREY && kind.depth <= 8) ? 1
                                                                                                                  : 3);
    assert_int_equal(image->transparent, kind.keyed || kind.color_type >= PNG_KIND_GREY_ALPHA);
    for (int n = 0; n < PNG_KIND_SIDE * PNG_KIND_SIDE; n++) {
        double read[3];
        naive_color(image, n % PNG_KIND_SIDE, n / PNG_KIND_SIDE, read);
        for (int i = 0; i < 3; i++) {
            double expected = expected_channel(kind, n % PNG_KIND_SIDE, n / PNG_KIND_SIDE, i, ground);
            bool opaque = alpha_of(kind, n % PNG_KIND_SIDE, n / PNG_KIND_SIDE) == 1;
            if (fabs(read[i] - expected) > (opaque ? 1e-9 : 0.500001 / (image->wide ? 65535 : 255)))
                fail_msg("type %d depth %d interlaced %d keyed %d: channel %d of pixel %d is %g, not %g",
                         kind.color_type, kind.depth, kind.interlaced, kind.keyed, i, n, read[i], expected);
        }
    }
}

static void check_over_white(const char *path, png_kind kind)
{
    image image = assert_read(path);
    assert_decoded(&image, kind, (double[]){1, 1, 1});
    image_release(&image);
}

static void every_legal_kind_is_read_without_loss(void **state)
{
    png_for_every_kind(check_over_white, temp_file(*state, "a.png"));
}

static void check_over_color(const char *path, png_kind kind)
{
    image image;
    octreel_error error;
    assert_true(image_read_png_over(path, (image_color){0, 51, 255}, &image, &error));
    assert_decoded(&image, kind, (double[]){0, 0.2, 1});
    image_release(&image);
}

static void transparent_pixels_are_blended_with_the_given_background(void **state)
{
    png_for_every_kind(check_over_color, temp_file(*state, "a.png"));
}

static void check_size(const char *path, png_kind kind)
{
    (void)kind;
    int width, height;
    assert_true(image_read_png_size(path, &width, &height));
    assert_true(width == PNG_KIND_SIDE && height == PNG_KIND_SIDE);
}

static void size_is_read_from_files_that_begin_and_end_as_png(void **state)
{
    const char *path = temp_file(*state, "a.png");
    png_for_every_kind(check_size, path);
    int width, height;
    png_bytes file;
    png_bytes_load(&file, path);
    png_bytes_save(&file, file.size - 1, path);
    assert_false(image_read_png_size(path, &width, &height));
    png_bytes_save(&file, 20, path);
    assert_false(image_read_png_size(path, &width, &height));
}

/* A file of 16 bits a sample that 8 would hold is the same picture, and is stored as one. */
static void sixteen_bit_files_that_fit_8_bits_become_8_bit(void **state)
{
    const char *path = temp_file(*state, "a.png");
    static const uint8_t row[] = {0, 7, 7, 255, 255, 0, 0, 90, 90, 91, 91, 92, 92};
    png_bytes file, rows = {.size = 0};
    png_bytes_put(&rows, row, sizeof row);
    png_put_header(&file, 2, 1, 16, PNG_KIND_RGB, false);
    png_put_rows_and_end(&file, &rows);
    png_bytes_save(&file, file.size, path);
    image image = assert_read(path);
    assert_false(image.wide);
    assert_memory_equal(image.pixels, ((uint8_t[]){7, 255, 0, 90, 91, 92}), 6);
    image_release(&image);
}

/* A picture of one row with these bytes a sample, each of which 16 bits hold twice; but the first sample is by `finer`
 * of 65535 off that. */
static void save_row(const char *path, int depth, int color_type, const uint8_t *samples, size_t count, uint8_t finer)
{
    static const uint8_t filter_none = 0;
    png_bytes file, rows = {.size = 0};
    png_bytes_put(&rows, &filter_none, 1);
    for (size_t i = 0; i < count; i++)
        png_bytes_put(&rows, (uint8_t[]){samples[i], samples[i] + (i == 0 ? finer : 0)}, depth == 16 ? 2 : 1);
    png_put_header(&file, (uint32_t)count / (uint32_t)png_samples_per_pixel(color_type), 1, depth, color_type, false);
    png_put_rows_and_end(&file, &rows);
    png_bytes_save(&file, file.size, path);
}

/* Laying alpha over rounds, to 8 bits here and to 16 there: the depth of a file must not show. */
static void transparency_gives_the_same_picture_in_8_and_16_bits(void **state)
{
    static const uint8_t samples[] = {10, 20, 30, 100, 200, 3, 77, 1, 255, 128, 0, 254, 9, 8, 7, 0, 1, 2, 3, 255};
    static const int types[] = {PNG_KIND_GREY_ALPHA, PNG_KIND_RGB_ALPHA};
    const char *path = temp_file(*state, "a.png");
    for (int i = 0; i < 2; i++) {
        save_row(path, 8, types[i], samples, sizeof samples, 0);
        image narrow = assert_read(path);
        save_row(path, 16, types[i], samples, sizeof samples, 0);
        image wide = assert_read(path);
        assert_false(wide.wide);
        assert_true(wide.transparent && narrow.transparent);
        assert_memory_equal(wide.pixels, narrow.pixels, 3 * (size_t)narrow.width);
        image_release(&narrow);
        image_release(&wide);
    }
}

/* One pixel that only 16 bits hold changes none of the others. */
static void blending_a_pixel_does_not_depend_on_other_pixels(void **state)
{
    static const uint8_t samples[] = {10, 20, 30, 100, 200, 3, 77, 1, 255, 128, 0, 254, 9, 8, 7, 0, 1, 2, 3, 255};
    const char *path = temp_file(*state, "a.png");
    save_row(path, 8, PNG_KIND_RGB_ALPHA, samples, sizeof samples, 0);
    image narrow = assert_read(path);
    save_row(path, 16, PNG_KIND_RGB_ALPHA, samples, sizeof samples, 2);
    image wide = assert_read(path);
    assert_true(wide.wide);
    for (int i = 3; i < 3 * wide.width; i++) {
        uint16_t sample;
        memcpy(&sample, wide.pixels + 2 * i, sizeof sample);
        assert_int_equal(sample, narrow.pixels[i] * 257);
    }
    image_release(&narrow);
    image_release(&wide);
}

static uint64_t color_space_of(const char *path, const char *type, const char *data, size_t size)
{
    png_bytes file, rows = {.size = 0};
    png_bytes_put(&rows, "\0\7\7\7", 4);
    png_put_header(&file, 1, 1, 8, PNG_KIND_RGB, false);
    if (*type)
        png_put_chunk(&file, type, data, size);
    png_put_chunk(&file, "tEXt", "Comment\0no colour", 17);
    png_put_rows_and_end(&file, &rows);
    png_bytes_save(&file, file.size, path);
    image image = assert_read(path);
    const uint64_t color_space = image.color_space;
    image_release(&image);
    return color_space;
}

static void colour_space_chunks_are_kept_as_a_digest(void **state)
{
    const char *path = temp_file(*state, "a.png");
    const uint64_t screen = color_space_of(path, "gAMA", "\0\0\xb1\x8f", 4);
    const uint64_t linear = color_space_of(path, "gAMA", "\0\1\x86\xa0", 4);
    const uint64_t standard = color_space_of(path, "sRGB", "\0", 1);
    const uint64_t profile = color_space_of(path, "iCCP", "name\0\0 what only libpng would look into", 38);
    assert_int_equal(color_space_of(path, "", "", 0), 0);
    assert_int_equal(color_space_of(path, "gAMA", "\0\0\xb1\x8f", 4), screen);
    assert_true(screen && linear && standard && profile);
    assert_true(screen != linear && screen != standard && linear != standard && profile != standard);
}

static void texts_are_found_by_their_keyword(void **state)
{
    static const image_text texts[] = {{"octreel:tick", "12"}, {"Comment", ""}, {"octreel:scene", "00ff"}};
    const char *path = temp_file(*state, "a.png");
    image_twins twins = make_twins(8, 8);
    octreel_error error;
    char text[5];
    assert_true(image_write_png(&twins.indexed, path, texts, 3, &error));
    for (int i = 0; i < 3; i++) {
        assert_true(image_read_text(path, texts[i].keyword, text, sizeof text));
        assert_string_equal(text, texts[i].text);
    }
    assert_true(image_read_text(path, "octreel:scene", text, 3));
    assert_string_equal(text, "00");
    assert_false(image_read_text(path, "octreel", text, sizeof text));
    assert_false(image_read_text(temp_file(*state, "missing.png"), "Comment", text, sizeof text));
    release_twins(&twins);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, temp_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(every_legal_kind_is_read_without_loss),
        WITH_FOLDER(transparent_pixels_are_blended_with_the_given_background),
        WITH_FOLDER(size_is_read_from_files_that_begin_and_end_as_png),
        WITH_FOLDER(sixteen_bit_files_that_fit_8_bits_become_8_bit),
        WITH_FOLDER(transparency_gives_the_same_picture_in_8_and_16_bits),
        WITH_FOLDER(blending_a_pixel_does_not_depend_on_other_pixels),
        WITH_FOLDER(colour_space_chunks_are_kept_as_a_digest),
        WITH_FOLDER(texts_are_found_by_their_keyword),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
