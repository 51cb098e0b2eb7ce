/* SPDX-License-Identifier: MIT */
/* png_read.h - reads PNG files of every kind into images, whole or in bands of rows. */
#ifndef IMAGE_PNG_READ_H
#define IMAGE_PNG_READ_H

#include "image.h"

/* The background colour with which image_read_png() blends transparent pixels: white. */
#define IMAGE_WHITE ((image_color){255, 255, 255})

/* Read a PNG of any kind without loss. Files with a palette, and grey files of up to 8 bits, become indexed images. All
 * other files become RGB, with 16 bits per sample only if 8 bits cannot hold the samples. Transparent pixels are
 * blended with white. Gamma and colour profiles do not change pixels; image.color_space holds their digest.
 *
 * Returns false, sets *error and zeroes the image if the file is not a regular file, is truncated, fails a checksum,
 * has a side beyond IMAGE_MAX_SIDE, or claims more pixels than a file of its size can encode.
 *
 * Memory: at most 8 bytes per pixel, and also at most 8300 times the file's size; in addition, a row in libpng and a
 * chunk of at most 8 MB. */
bool image_read_png(const char *path, image *image, octreel_error *error);

/* Read a PNG under the rules of image_read_png(), but blend transparent pixels with `background`. */
bool image_read_png_over(const char *path, image_color background, image *image, octreel_error *error);

/* A PNG file whose rows are decoded on demand, so that the whole picture need not be in memory. Opening the file
 * nevertheless reads all rows if `whole` is true, if the file is interlaced, or if it has 16 bits per sample. Not
 * thread-safe. */
typedef struct image_source image_source;

/* Open a file under the rules of image_read_png(). Returns null and sets *error on failure. `path` and `error` must
 * outlive the source. */
image_source *image_source_open(const char *path, image_color background, bool whole, octreel_error *error);
void image_source_close(image_source *source); /* `source` may be null */

/* Returns the description of the image. The description's `pixels` are null unless all rows are in memory. */
const image *image_source_description(const image_source *source);

/* Read the next rows, at most `rows`, as an image. The source owns the image's pixels, which are valid until the next
 * call, so the caller must not release the image. Returns false after the last row. Returns false and sets *error if
 * reading fails. The end of the file is checked before the last rows are returned. */
bool image_source_read_band(image_source *source, int rows, image *band);
bool image_source_has_failed(const image_source *source);

/* Returns the number of rows in a band. The number is small enough that several bands fit the L2 cache, and large
 * enough that the cost per band is small. */
static inline int image_find_band_height(const image *about)
{
    enum { BAND_PIXELS = 1 << 14 };
    return about->width < BAND_PIXELS ? BAND_PIXELS / about->width : 1;
}

#endif
