/* test_png_read.c - PNG files of every kind to RGB: the legal ones rightly, the hostile ones with a sentence. */
#include "images.h"
#include "png_by_hand.h"
#include "temp_folder.h"

#include <errno.h>
#include <string.h>

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

/* What a channel must be, 0 to 255, before it is rounded. */
static double expected_channel(kind kind, int x, int y, int channel)
{
    double alpha = alpha_of(kind, x, y);
    double value;
    if (kind.color_type == PALETTE) {
        image_color color = palette_color(sample_at(kind, x, y, 0));
        value = channel == 0 ? color.r : channel == 1 ? color.g : color.b;
    } else {
        bool grey = kind.color_type == GREY || kind.color_type == GREY_ALPHA;
        value = 255.0 * sample_at(kind, x, y, grey ? 0 : channel) / largest_of(kind);
    }
    return value * alpha + 255 * (1 - alpha);
}

static void assert_decoded(const image *image, kind kind)
{
    assert_true(image->width == SIDE && image->height == SIDE);
    /* 16-bit colours and alphas are rounded to 8 bits first. */
    bool wide_alpha = kind.depth == 16 && kind.color_type >= GREY_ALPHA;
    double tolerance = wide_alpha ? 1.5 : 0.5;
    for (int n = 0; n < 3 * SIDE * SIDE; n++) {
        double expected = expected_channel(kind, n / 3 % SIDE, n / 3 / SIDE, n % 3);
        double off = image->pixels[n] - expected;
        if (off > tolerance || off < -tolerance)
            fail_msg("type %d depth %d interlaced %d keyed %d: sample %d is %d, not %g", kind.color_type, kind.depth,
                     kind.interlaced, kind.keyed, n, image->pixels[n], expected);
    }
}

static void every_legal_kind_is_read_as_rgb_over_white(void **state)
{
    static const int stored[][2] = {{GREY, 1},    {GREY, 2},       {GREY, 4},        {GREY, 8},      {GREY, 16},
                                    {RGB, 8},     {RGB, 16},       {PALETTE, 1},     {PALETTE, 2},   {PALETTE, 4},
                                    {PALETTE, 8}, {GREY_ALPHA, 8}, {GREY_ALPHA, 16}, {RGB_ALPHA, 8}, {RGB_ALPHA, 16}};
    const char *path = temp_file(*state, "a.png");
    for (size_t i = 0; i < sizeof stored / sizeof stored[0]; i++) {
        for (int variant = 0; variant < 4; variant++) {
            kind kind = {stored[i][0], stored[i][1], variant % 2 == 1, variant / 2 == 1};
            if (kind.keyed && kind.color_type >= GREY_ALPHA)
                continue;
            png_bytes file;
            make_png(&file, kind);
            png_bytes_save(&file, file.size, path);
            image image = assert_read(path);
            assert_decoded(&image, kind);
            image_release(&image);
        }
    }
}

static void assert_unreadable(const char *path, const char *reason)
{
    image image;
    image_error error = {""};
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
    assert_unreadable(folder->name, strerror(EISDIR));
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
    image_error error = {""};
    assert_false(image_read_png(path, &image, &error));
    assert_non_null(strstr(error.text, strerror(ENAMETOOLONG)));
}

static void texts_are_found_by_their_keyword(void **state)
{
    static const image_text texts[] = {{"octreel:tick", "12"}, {"Comment", ""}, {"octreel:scene", "00ff"}};
    const char *path = temp_file(*state, "a.png");
    image_twins twins = make_twins(8, 8);
    image_error error;
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
        WITH_FOLDER(every_legal_kind_is_read_as_rgb_over_white),
        WITH_FOLDER(missing_file_and_folder_are_told_apart),
        WITH_FOLDER(what_is_no_png_is_refused),
        WITH_FOLDER(truncation_anywhere_is_an_error),
        WITH_FOLDER(wrong_crc_of_any_chunk_is_an_error),
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
