/* SPDX-License-Identifier: MIT */
/* fuzz_png.c - libFuzzer entry of the PNG reader and the comparison of pictures, with files of png_input.h. No input
 * may take more memory than the reader promises. Build with clang -fsanitize=fuzzer,address,undefined.
 */
#include "image_compare.h"
#include "image_digest.h"
#include "support/png_input.h"
#include "png_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* ---- What must hold ----------------------------------------------------------------------------------------- */

static void check(bool holds)
{
    if (!holds)
        abort();
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
static void check_rows(const png_input *f, image_color background, const image *whole, const octreel_error *failed)
{
    octreel_error error = {""};
    image_source *source = image_source_open(png_input_save(f), background, false, &error);
    const bool ok = source && read_rows(source, 1 + (int)(f->size % 5), whole);
    check(ok == (whole->pixels != NULL) && strcmp(error.text, failed->text) == 0);
    image_source_close(source);
}

static bool read_file(const png_input *f, image_color background, image *read)
{
    octreel_error error = {""};
    const char *path = png_input_save(f);
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
    static png_input f;
    image white, black;
    if (size < 2 || size > PNG_INPUT_MOST / 2)
        return 0;
    png_input_make(&f, data, size);
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
