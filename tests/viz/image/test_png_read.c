/* SPDX-License-Identifier: MIT */
/* test_png_read.c - PNG files of every kind to pixels: the legal ones without loss, the hostile ones with a sentence.
 */
#include "images.h"
#include "naive_compare.h"
#include "png_by_hand.h"
#include "temp_folder.h"
#include "png_chunks.h"

#include <errno.h>
#include <math.h>
#include <png.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <zlib.h>

/* A way of storing pixels in a PNG. */
typedef struct kind {
    int color_type, depth;
    bool interlaced;
    bool keyed; /* with a tRNS chunk */
} kind;

enum { GREY = 0, RGB = 2, PALETTE = 3, GREY_ALPHA = 4, RGB_ALPHA = 6, SIDE = 21, PALETTE_ALPHAS = 2 };

static int samples_of(int color_type)
{
    static const int samples[] = {[GREY] = 1, [RGB] = 3, [PALETTE] = 1, [GREY_ALPHA] = 2, [RGB_ALPHA] = 4};
    return samples[color_type];
}

static unsigned largest_of(kind kind)
{
    return (1u << kind.depth) - 1;
}

/* The stored value of one sample: a pattern that meets the smallest, the largest and the keyed value. */
static unsigned sample_at(kind kind, int x, int y, int sample)
{
    unsigned mixed = (unsigned)(x * 40503 + y * 2654435 + sample * 977) * 2654435761u >> 16;
    if ((x + y) % 5 == 0)
        return 0;
    if ((x + y) % 5 == 1)
        return largest_of(kind);
    return mixed & largest_of(kind);
}

/* The palette's colour for an index; 2^depth entries. */
static image_color palette_color(unsigned index)
{
    return (image_color){(uint8_t)(index * 11), (uint8_t)(255 - index), (uint8_t)(index * 101)};
}

static uint8_t palette_alpha(unsigned index)
{
    static const uint8_t alphas[PALETTE_ALPHAS] = {0, 100};
    return index < PALETTE_ALPHAS ? alphas[index] : 255;
}

static void put_row(png_bytes *rows, kind kind, int y, int first_x, int step_x)
{
    static const uint8_t filter_none = 0;
    png_bytes_put(rows, &filter_none, 1);
    unsigned bits = 0, bit_count = 0;
    for (int x = first_x; x < SIDE; x += step_x) {
        for (int sample = 0; sample < samples_of(kind.color_type); sample++) {
            bits = bits << kind.depth | sample_at(kind, x, y, sample);
            bit_count += (unsigned)kind.depth;
            for (; bit_count >= 8; bit_count -= 8)
                png_bytes_put(rows, &(uint8_t){(uint8_t)(bits >> (bit_count - 8))}, 1);
        }
    }
    if (bit_count > 0)
        png_bytes_put(rows, &(uint8_t){(uint8_t)(bits << (8 - bit_count))}, 1);
}

static void put_all_rows(png_bytes *rows, kind kind)
{
    static const int whole[][4] = {{0, 0, 1, 1}}; /* first x, first y, step x, step y */
    static const int adam7[][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                   {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
    const int(*passes)[4] = kind.interlaced ? adam7 : whole;
    int count = kind.interlaced ? 7 : 1;
    for (int i = 0; i < count; i++) {
        for (int y = passes[i][1]; y < SIDE; y += passes[i][3])
            put_row(rows, kind, y, passes[i][0], passes[i][2]);
    }
}

/* tRNS: the first two alphas of a palette, or the colour of pixel (3, 0) as the one that is clear. */
static void put_key(png_bytes *out, kind kind)
{
    uint8_t data[6];
    size_t size = PALETTE_ALPHAS;
    if (kind.color_type == PALETTE) {
        for (unsigned i = 0; i < PALETTE_ALPHAS; i++)
            data[i] = palette_alpha(i);
    } else {
        size = 2 * (size_t)samples_of(kind.color_type);
        for (size_t i = 0; i < size; i++)
            data[i] = (uint8_t)(sample_at(kind, 3, 0, (int)i / 2) >> (i % 2 == 0 ? 8 : 0));
    }
    png_put_chunk(out, "tRNS", data, size);
}

static void make_png(png_bytes *out, kind kind)
{
    png_bytes rows = {.size = 0};
    png_put_header(out, SIDE, SIDE, kind.depth, kind.color_type, kind.interlaced);
    png_put_chunk(out, "gAMA", "\0\0\x40\0", 4); /* must not change a pixel */
    if (kind.color_type == PALETTE) {
        png_bytes palette = {.size = 0};
        for (unsigned i = 0; i <= largest_of(kind); i++) {
            image_color color = palette_color(i);
            png_bytes_put(&palette, &color, 3);
        }
        png_put_chunk(out, "PLTE", palette.data, palette.size);
    }
    if (kind.keyed)
        put_key(out, kind);
    put_all_rows(&rows, kind);
    png_put_rows_and_end(out, &rows);
}

static double alpha_of(kind kind, int x, int y)
{
    int samples = samples_of(kind.color_type);
    if (kind.color_type == GREY_ALPHA || kind.color_type == RGB_ALPHA)
        return (double)sample_at(kind, x, y, samples - 1) / largest_of(kind);
    if (!kind.keyed)
        return 1;
    if (kind.color_type == PALETTE)
        return palette_alpha(sample_at(kind, x, y, 0)) / 255.0;
    for (int i = 0; i < samples; i++) {
        if (sample_at(kind, x, y, i) != sample_at(kind, 3, 0, i))
            return 1;
    }
    return 0;
}

/* What a channel must be, 0 to 1. */
static double expected_channel(kind kind, int x, int y, int channel, const double ground[3])
{
    double alpha = alpha_of(kind, x, y);
    double value;
    if (kind.color_type == PALETTE) {
        image_color color = palette_color(sample_at(kind, x, y, 0));
        value = (channel == 0 ? color.r : channel == 1 ? color.g : color.b) / 255.0;
    } else {
        bool grey = kind.color_type == GREY || kind.color_type == GREY_ALPHA;
        value = (double)sample_at(kind, x, y, grey ? 0 : channel) / largest_of(kind);
    }
    return value * alpha + ground[channel] * (1 - alpha);
}

/* As near as the image's samples can be: opaque pixels exactly, of whatever depth. */
static void assert_decoded(const image *image, kind kind, const double ground[3])
{
    assert_true(image->width == SIDE && image->height == SIDE);
    assert_int_equal(image->wide, kind.depth == 16);
    assert_int_equal(image->channels,
                     kind.color_type == PALETTE || (kind.color_type == GREY && kind.depth <= 8) ? 1 : 3);
    assert_int_equal(image->transparent, kind.keyed || kind.color_type >= GREY_ALPHA);
    for (int n = 0; n < SIDE * SIDE; n++) {
        double read[3];
        naive_color(image, n % SIDE, n / SIDE, read);
        for (int i = 0; i < 3; i++) {
            double expected = expected_channel(kind, n % SIDE, n / SIDE, i, ground);
            bool opaque = alpha_of(kind, n % SIDE, n / SIDE) == 1;
            if (fabs(read[i] - expected) > (opaque ? 1e-9 : 0.500001 / (image->wide ? 65535 : 255)))
                fail_msg("type %d depth %d interlaced %d keyed %d: channel %d of pixel %d is %g, not %g",
                         kind.color_type, kind.depth, kind.interlaced, kind.keyed, i, n, read[i], expected);
        }
    }
}

/* Every kind, interlaced or not, with and without a colour that is clear. */
static void for_every_kind(void (*visit)(const char *path, kind kind), const char *path)
{
    static const int stored[][2] = {{GREY, 1},    {GREY, 2},       {GREY, 4},        {GREY, 8},      {GREY, 16},
                                    {RGB, 8},     {RGB, 16},       {PALETTE, 1},     {PALETTE, 2},   {PALETTE, 4},
                                    {PALETTE, 8}, {GREY_ALPHA, 8}, {GREY_ALPHA, 16}, {RGB_ALPHA, 8}, {RGB_ALPHA, 16}};
    for (size_t i = 0; i < sizeof stored / sizeof stored[0]; i++) {
        for (int variant = 0; variant < 4; variant++) {
            kind kind = {stored[i][0], stored[i][1], variant % 2 == 1, variant / 2 == 1};
            if (kind.keyed && kind.color_type >= GREY_ALPHA)
                continue;
            png_bytes file;
            make_png(&file, kind);
            png_bytes_save(&file, file.size, path);
            visit(path, kind);
        }
    }
}

static void check_over_white(const char *path, kind kind)
{
    image image = assert_read(path);
    assert_decoded(&image, kind, (double[]){1, 1, 1});
    image_release(&image);
}

static void every_legal_kind_is_read_without_loss(void **state)
{
    for_every_kind(check_over_white, temp_file(*state, "a.png"));
}

static void check_over_color(const char *path, kind kind)
{
    image image;
    octreel_error error;
    assert_true(image_read_png_over(path, (image_color){0, 51, 255}, &image, &error));
    assert_decoded(&image, kind, (double[]){0, 0.2, 1});
    image_release(&image);
}

static void every_legal_kind_lies_over_the_background_asked_for(void **state)
{
    for_every_kind(check_over_color, temp_file(*state, "a.png"));
}

static void check_size(const char *path, kind kind)
{
    (void)kind;
    int width, height;
    assert_true(image_png_size(path, &width, &height));
    assert_true(width == SIDE && height == SIDE);
}

static void size_is_told_of_files_that_begin_and_end_as_png(void **state)
{
    const char *path = temp_file(*state, "a.png");
    for_every_kind(check_size, path);
    int width, height;
    png_bytes file;
    png_bytes_load(&file, path);
    png_bytes_save(&file, file.size - 1, path);
    assert_false(image_png_size(path, &width, &height));
    png_bytes_save(&file, 20, path);
    assert_false(image_png_size(path, &width, &height));
}

/* A file of 16 bits a sample that 8 would hold is the same picture, and is stored as one. */
static void wide_files_of_narrow_pictures_become_narrow(void **state)
{
    const char *path = temp_file(*state, "a.png");
    static const uint8_t row[] = {0, 7, 7, 255, 255, 0, 0, 90, 90, 91, 91, 92, 92};
    png_bytes file, rows = {.size = 0};
    png_bytes_put(&rows, row, sizeof row);
    png_put_header(&file, 2, 1, 16, RGB, false);
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
    png_put_header(&file, (uint32_t)count / (uint32_t)samples_of(color_type), 1, depth, color_type, false);
    png_put_rows_and_end(&file, &rows);
    png_bytes_save(&file, file.size, path);
}

/* Laying alpha over rounds, to 8 bits here and to 16 there: the depth of a file must not show. */
static void what_is_transparent_is_the_same_picture_in_8_and_16_bits(void **state)
{
    static const uint8_t samples[] = {10, 20, 30, 100, 200, 3, 77, 1, 255, 128, 0, 254, 9, 8, 7, 0, 1, 2, 3, 255};
    static const int types[] = {GREY_ALPHA, RGB_ALPHA};
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
static void a_pixel_is_laid_over_alike_whatever_the_others_are(void **state)
{
    static const uint8_t samples[] = {10, 20, 30, 100, 200, 3, 77, 1, 255, 128, 0, 254, 9, 8, 7, 0, 1, 2, 3, 255};
    const char *path = temp_file(*state, "a.png");
    save_row(path, 8, RGB_ALPHA, samples, sizeof samples, 0);
    image narrow = assert_read(path);
    save_row(path, 16, RGB_ALPHA, samples, sizeof samples, 2);
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
    png_put_header(&file, 1, 1, 8, RGB, false);
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

static void what_samples_mean_is_kept_as_one_number(void **state)
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

static void missing_file_and_folder_are_told_apart(void **state)
{
    temp_folder *folder = *state;
    assert_unreadable(temp_file(folder, "missing.png"), strerror(ENOENT));
    assert_unreadable(folder->name, "is not a regular file");
}

static void what_is_no_png_is_refused(void **state)
{
    png_bytes file = {.size = 0};
    assert_bytes_unreadable(&file, temp_file(*state, "a.png"), "cut short");
    png_bytes_put(&file, "P6 2 2 255\nabcdefghijkl", 23);
    assert_bytes_unreadable(&file, temp_file(*state, "a.png"), "PNG");
}

static void truncation_anywhere_is_an_error(void **state)
{
    const char *path = temp_file(*state, "a.png");
    png_bytes file;
    make_png(&file, (kind){RGB_ALPHA, 16, true, false});
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
    make_png(&file, (kind){PALETTE, 8, false, true});
    size_t at = 8;
    while (at < file.size) {
        at = png_chunk_at(&file, at).next;
        file.data[at - 1] ^= 1;
        assert_bytes_unreadable(&file, path, "CRC");
        file.data[at - 1] ^= 1;
    }
}

/* Every byte has a CRC; the stream's own Adler-32 is not asked as well, where libpng can be told so. */
static void stream_with_a_wrong_sum_of_its_own_is_read_as_it_is(void **state)
{
    const char *path = temp_file(*state, "a.png");
    static const uint8_t rows[] = {0, 10, 20, 30, 0, 40, 50, 60};
    uint8_t packed[64];
    uLongf size = sizeof packed;
    png_bytes file;
    assert_int_equal(compress(packed, &size, rows, sizeof rows), Z_OK);
    packed[size - 1] ^= 1;
    png_put_header(&file, 3, 2, 8, GREY, false);
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
    make_png(&file, (kind){PALETTE, 2, false, true});
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
        png_put_header(&file, sizes[i][0], sizes[i][1], 8, GREY, true);
        png_put_rows_and_end(&file, &rows);
        assert_bytes_unreadable(&file, path, i < 5 ? "side" : "");
    }
}

/* A picture that this program may read, in a file of a few bytes. */
static void pixels_that_a_file_is_too_short_for_are_refused(void **state)
{
    static const int types[] = {GREY, RGB, GREY_ALPHA, RGB_ALPHA};
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
    png_put_header(&file, 4, 4, 8, GREY, false);
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
        png_put_header(&file, 2, 1, 8, PALETTE, interlaced);
        png_put_chunk(&file, "PLTE", "abcdef", 6);
        png_put_rows_and_end(&file, &rows);
        assert_bytes_unreadable(&file, path, "palette");
    }
}

static void illegal_headers_are_refused(void **state)
{
    static const int stored[][2] = {{RGB, 4}, {PALETTE, 16}, {GREY, 3}, {1, 8}, {7, 8}, {GREY_ALPHA, 1}};
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
    png_put_header(&file, 4, 4, 8, PALETTE, false);
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
        WITH_FOLDER(every_legal_kind_lies_over_the_background_asked_for),
        WITH_FOLDER(size_is_told_of_files_that_begin_and_end_as_png),
        WITH_FOLDER(wide_files_of_narrow_pictures_become_narrow),
        WITH_FOLDER(what_is_transparent_is_the_same_picture_in_8_and_16_bits),
        WITH_FOLDER(a_pixel_is_laid_over_alike_whatever_the_others_are),
        WITH_FOLDER(what_samples_mean_is_kept_as_one_number),
        WITH_FOLDER(pixels_that_a_file_is_too_short_for_are_refused),
        WITH_FOLDER(pipe_is_refused_without_waiting),
        WITH_FOLDER(missing_file_and_folder_are_told_apart),
        WITH_FOLDER(what_is_no_png_is_refused),
        WITH_FOLDER(truncation_anywhere_is_an_error),
        WITH_FOLDER(wrong_crc_of_any_chunk_is_an_error),
        WITH_FOLDER(stream_with_a_wrong_sum_of_its_own_is_read_as_it_is),
        WITH_FOLDER(any_flipped_bit_is_an_error),
        WITH_FOLDER(huge_sides_are_refused_before_memory_is_spent),
        WITH_FOLDER(too_few_pixels_are_an_error),
        WITH_FOLDER(index_beyond_the_palette_is_an_error),
        WITH_FOLDER(illegal_headers_are_refused),
        WITH_FOLDER(palette_file_without_palette_is_refused),
        cmocka_unit_test(overlong_path_still_gets_its_reason),
        WITH_FOLDER(texts_are_found_by_their_keyword),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
