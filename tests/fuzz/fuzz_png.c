/* SPDX-License-Identifier: MIT */
/* fuzz_png.c - libFuzzer entry of the PNG reader and the comparison of pictures. The first byte says what the rest is:
 * a file; a file whose checksums are corrected, so that the code behind the checks is reached; or a recipe for a valid
 * file. No input may take more memory than the reader promises. Build with clang -fsanitize=fuzzer,address,undefined.
 */
#undef _POSIX_C_SOURCE
#define _GNU_SOURCE /* for memfd_create() */
#include "image_compare.h"
#include "image_digest.h"
#include "png_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { AS_IT_IS, WITH_CHECKSUMS, RECIPE, MODES, MOST = 1 << 16 };

typedef struct file {
    uint8_t bytes[2 * MOST];
    size_t size;
} file;

/* ---- Files from input --------------------------------------------------------------------------------------- */

static uint32_t read_u32(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static void write_u32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> (24 - 8 * i));
}

static void repair_checksums(file *f)
{
    for (size_t at = 8; at + 12 <= f->size;) {
        const uint32_t length = read_u32(f->bytes + at);
        if (length > f->size - at - 12)
            return;
        write_u32(f->bytes + at + 8 + length, (uint32_t)crc32(0, f->bytes + at + 4, length + 4));
        at += 12 + (size_t)length;
    }
}

static void put_chunk(file *f, const char *type, const uint8_t *data, size_t size)
{
    uint8_t *at = f->bytes + f->size;
    write_u32(at, (uint32_t)size);
    memcpy(at + 4, type, 4);
    if (size > 0)
        memcpy(at + 8, data, size);
    write_u32(at + 8 + size, (uint32_t)crc32(0, at + 4, (uInt)(size + 4)));
    f->size += size + 12;
}

/* A recipe: kind, sides, number of colours and of alphas, these values, and then rows with their filter bytes. */
static void follow_recipe(file *f, const uint8_t *data, size_t size)
{
    static const uint8_t kinds[][2] = {{0, 1}, {0, 2}, {0, 4}, {0, 8}, {0, 16}, {2, 8}, {2, 16}, {3, 1},
                                       {3, 2}, {3, 4}, {3, 8}, {4, 8}, {4, 16}, {6, 8}, {6, 16}};
    enum { HEAD = 6, KINDS = sizeof kinds / sizeof kinds[0] };
    if (size < HEAD)
        return;
    const uint8_t *kind = kinds[data[0] % KINDS], *rest = data + HEAD;
    size_t left = size - HEAD;
    const size_t colors = 3u * data[4] < left ? 3u * data[4] : left;
    const size_t alphas = data[5] < left - colors ? data[5] : left - colors;
    const uint8_t header[13] = {0, 0, 0, data[1], 0, 0, 0, data[2], kind[1], kind[0], 0, 0, data[3] & 1};
    static uint8_t packed[MOST];
    uLongf packed_size = sizeof packed;
    memcpy(f->bytes, "\x89PNG\r\n\x1a\n", 8);
    f->size = 8;
    put_chunk(f, "IHDR", header, sizeof header);
    if (colors > 0)
        put_chunk(f, "PLTE", rest, colors);
    if (alphas > 0)
        put_chunk(f, "tRNS", rest + colors, alphas);
    if (compress(packed, &packed_size, rest + colors + alphas, left - colors - alphas) == Z_OK)
        put_chunk(f, "IDAT", packed, packed_size);
    put_chunk(f, "IEND", NULL, 0);
}

static void make_file(file *f, const uint8_t *data, size_t size)
{
    f->size = 0;
    if (data[0] % MODES == RECIPE) {
        follow_recipe(f, data + 1, size - 1);
        return;
    }
    memcpy(f->bytes, data + 1, size - 1);
    f->size = size - 1;
    if (data[0] % MODES == WITH_CHECKSUMS)
        repair_checksums(f);
}

/* ---- What must hold ----------------------------------------------------------------------------------------- */

static void check(bool holds)
{
    if (!holds)
        abort();
}

/* Write a file into memory. Returns the path by which it is read. */
static const char *save(const file *f)
{
    static int memory = -1;
    static char path[40];
    if (memory < 0)
        memory = memfd_create("fuzz", 0);
    snprintf(path, sizeof path, "/proc/self/fd/%d", memory);
    check(memory >= 0 && ftruncate(memory, 0) == 0 && pwrite(memory, f->bytes, f->size, 0) == (ssize_t)f->size);
    return path;
}

/* Read a file in bands, until it fails: the rows must equal those of the whole picture. */
static bool read_rows(image_source *source, int rows, const image *whole)
{
    int y = 0;
    for (image band; image_source_read_band(source, rows, &band); y += band.height) {
        const size_t size = (size_t)band.width * image_pixel_size(&band);
        check(!whole->pixels || image_pixel_size(&band) == image_pixel_size(whole));
        check(!whole->pixels || memcmp(band.pixels, whole->pixels + (size_t)y * size, size * (size_t)band.height) == 0);
    }
    return !image_source_has_failed(source) && y == image_source_description(source)->height;
}

/* Reading row by row must succeed or fail exactly like reading the whole file. */
static void check_rows(const file *f, image_color background, const image *whole, const octreel_error *failed)
{
    octreel_error error = {""};
    image_source *source = image_source_open(save(f), background, false, &error);
    const bool ok = source && read_rows(source, 1 + (int)(f->size % 5), whole);
    check(ok == (whole->pixels != NULL) && strcmp(error.text, failed->text) == 0);
    image_source_close(source);
}

static bool read_file(const file *f, image_color background, image *read)
{
    octreel_error error = {""};
    const char *path = save(f);
    const bool ok = image_read_png_over(path, background, read, &error);
    check(ok ? read->pixels != NULL : read->pixels == NULL && strncmp(error.text, path, strlen(path)) == 0);
    check_rows(f, background, read, &error);
    return ok;
}

static void check_image(const image *read, size_t file_size)
{
    const size_t pixels = (size_t)read->width * (size_t)read->height;
    check(read->width >= 1 && read->width <= IMAGE_MAX_SIDE && read->height >= 1 && read->height <= IMAGE_MAX_SIDE);
    check(read->channels == 3 || (read->channels == 1 && !read->wide && image_has_valid_indices(read)));
    check(pixels <= 8300 * file_size);
}

/* An 8-bit image with the same colours must be equal, by comparison and by digest. */
static void check_twin(const image *read)
{
    image twin;
    check(image_create(&twin, read->width, read->height, 3));
    uint8_t *at = twin.pixels;
    for (int y = 0; y < read->height; y++) {
        for (int x = 0; x < read->width; x++, at += 3) {
            const image_color color = image_color_at(read, x, y);
            memcpy(at, &color, 3);
        }
    }
    const image_difference difference = image_compare(read, &twin);
    check(read->wide || image_has_no_difference(&difference));
    check(read->wide || image_digest(read) == image_digest(&twin));
    image_release(&twin);
}

static void check_sums(const image *a, const image *b)
{
    static const image_rectangle corner = {2, 1, 5, 3};
    const image_tolerance tolerance = {.max_delta = 0.05, .antialias = true, .ignored = &corner, .ignored_count = 1};
    const image_difference exact = image_compare(a, b), d = image_compare_within(a, b, &tolerance);
    check(d.same_size && d.unlike.pixels + d.ignored == exact.unlike.pixels);
    check(d.counted.pixels + d.close + d.antialiased == d.unlike.pixels);
    check(exact.unlike.worst_delta >= 0 && exact.unlike.worst_delta <= 1);
    check((exact.unlike.pixels == 0) == (image_digest(a) == image_digest(b)));
    check(exact.unlike.largest_channel <= exact.channel_range);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static file f;
    image white, black;
    if (size < 2 || size > MOST / 2)
        return 0;
    make_file(&f, data, size);
    if (f.size == 0 || !read_file(&f, (image_color){255, 255, 255}, &white))
        return 0;
    check_image(&white, f.size);
    check_twin(&white);
    check(read_file(&f, (image_color){0, 0, 0}, &black));
    check_sums(&white, &black);
    check(white.transparent || image_digest(&white) == image_digest(&black));
    image_release(&white);
    image_release(&black);
    return 0;
}
