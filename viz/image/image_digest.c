/* SPDX-License-Identifier: MIT */
#include "image_digest.h"
#include "octree/digest.h"
#include "png_read.h"

#include <string.h>

/* The colour of the n-th pixel in reading order as one word: 8 bits a sample, or 16. */
static uint64_t color_word(const image *image, size_t n)
{
    const uint8_t *at = image->pixels + n * image_pixel_size(image);
    if (image->wide) {
        uint16_t samples[3];
        memcpy(samples, at, sizeof samples);
        return (uint64_t)samples[0] << 32 | (uint64_t)samples[1] << 16 | samples[2];
    }
    const image_color color = image->channels == 1 ? image->palette.colors[*at] : (image_color){at[0], at[1], at[2]};
    return (uint64_t)color.r << 16 | (uint64_t)color.g << 8 | color.b;
}

/* The end of the run of pixels equal to pixel `start`. Eight bytes at a time are compared with those one pixel earlier,
 * since a frame is mostly background. */
static size_t run_end(const image *image, size_t start, size_t pixel_count)
{
    const size_t step = image_pixel_size(image);
    const uint8_t *first = image->pixels + start * step;
    const size_t rest = (pixel_count - start - 1) * step;
    return start + 1 + image_bytes_alike(first + step, first, rest) / step;
}

static uint64_t digest_run(uint64_t digest, size_t length, uint64_t color, bool wide)
{
    if (length == 0)
        return digest;
    if (wide)
        return octree_digest_word(octree_digest_word(digest, (uint64_t)length), color);
    return octree_digest_word(digest, (uint64_t)length << 24 | color);
}

/* A digest in progress, over runs of one colour. Adjacent runs of different indices may have the same colour, and runs
 * may continue in the next rows: these are joined, so that the digest depends neither on the palette nor on bands. */
typedef struct digesting {
    uint64_t digest;
    uint64_t color; /* of the current run */
    size_t length;
    bool wide;
} digesting;

static digesting begin(const image *about)
{
    const uint64_t start = octree_digest_word(OCTREE_DIGEST_START, (uint64_t)about->width);
    return (digesting){.digest = octree_digest_word(start, (uint64_t)about->height), .wide = about->wide};
}

static void add_rows(digesting *d, const image *rows)
{
    const size_t pixel_count = (size_t)rows->width * (size_t)rows->height;
    for (size_t at = 0, end; at < pixel_count; at = end) {
        end = run_end(rows, at, pixel_count);
        const uint64_t next = color_word(rows, at);
        if (next != d->color) {
            d->digest = digest_run(d->digest, d->length, d->color, d->wide);
            d->color = next;
            d->length = 0;
        }
        d->length += end - at;
    }
}

static uint64_t finish(const digesting *d)
{
    return digest_run(d->digest, d->length, d->color, d->wide);
}

uint64_t image_digest(const image *image)
{
    digesting d = begin(image);
    add_rows(&d, image);
    return finish(&d);
}

static const char *const kind_names[] = {
#define KIND_NAME(kind, name) name,
    IMAGE_DIGEST_MAP(KIND_NAME)
#undef KIND_NAME
};

const char *image_digest_kind_name(image_digest_kind kind)
{
    return kind_names[kind];
}

image_digest_kind image_digest_kind_of(const char *name, size_t length)
{
    int kind = 0;
    while (kind < IMAGE_DIGEST_KINDS && (strlen(kind_names[kind]) != length || memcmp(kind_names[kind], name, length)))
        kind++;
    return (image_digest_kind)kind;
}

bool image_digest_png_of(image_digest_kind kind, const char *path, image_color background, image *about,
                         uint64_t *digest, octreel_error *error)
{
    switch (kind) {
    case IMAGE_DIGEST_RUNS:
        return image_digest_png(path, background, about, digest, error);
    default:
        return error_set(error, "%s: there is no such kind of digest", path);
    }
}

bool image_digest_png(const char *path, image_color background, image *about, uint64_t *digest, octreel_error *error)
{
    image_source *source = image_source_open(path, background, false, error);
    if (!source)
        return false;
    *about = *image_source_about(source);
    about->pixels = NULL;
    const int rows = image_band_rows(about);
    digesting d = begin(about);
    for (image band; image_source_next(source, rows, &band);)
        add_rows(&d, &band);
    *digest = finish(&d);
    const bool done = !image_source_failed(source);
    image_source_close(source);
    return done;
}
