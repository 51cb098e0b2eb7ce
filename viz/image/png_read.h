/* SPDX-License-Identifier: MIT */
/* png_read.h - PNG files of every kind to images: whole, or row by row. */
#ifndef IMAGE_PNG_READ_H
#define IMAGE_PNG_READ_H

#include "image.h"

/* The default background of transparent pictures. */
#define IMAGE_WHITE ((image_color){255, 255, 255})

/* Read any PNG without loss: palettes, and greys of up to 8 bits, become indexed images, the others RGB ones, with 16
 * bits a sample only where 8 cannot hold them. What is transparent is laid over white; gamma and colour profiles
 * change no pixel (image.color_space tells them apart). Refused are irregular files, files that are cut short or fail a
 * checksum, sides beyond IMAGE_MAX_SIDE, and more pixels than the file's size can encode: memory stays within 8 bytes a
 * pixel, and within 8300 times the file's size, beside what libpng needs for a row and a chunk, of 8 MB at most. On
 * failure the image is zeroed. */
bool image_read_png(const char *path, image *image, octreel_error *error);

/* The same over a given background. */
bool image_read_png_over(const char *path, image_color background, image *image, octreel_error *error);

/* The rows of a PNG, decoded on demand, so that it is never in memory as a whole. All rows are read at opening if
 * `whole` is set, or if the file is interlaced or has 16 bits a sample. One thread at a time may use it. */
typedef struct image_source image_source;

/* Open under the rules of image_read_png(). Null, with an error, on failure; path and error must outlive the source. */
image_source *image_source_open(const char *path, image_color background, bool whole, octreel_error *error);
void image_source_close(image_source *source); /* null is allowed */

/* The image; its pixels are null unless all rows are in memory. */
const image *image_source_about(const image_source *source);

/* The next rows, at most `rows`, as an image that is not to be released: its pixels belong to the source, and are valid
 * until the next call. False after the last row, or, with a sentence, when reading fails. The end of the file is
 * checked before its last rows are returned. */
bool image_source_next(image_source *source, int rows, image *band);
bool image_source_failed(const image_source *source);

/* How many rows to read at a time: few enough for several such bands to fit the L2 cache, and enough that the cost per
 * band does not matter. */
static inline int image_band_rows(const image *about)
{
    enum { BAND_PIXELS = 1 << 14 };
    return about->width < BAND_PIXELS ? BAND_PIXELS / about->width : 1;
}

#endif
