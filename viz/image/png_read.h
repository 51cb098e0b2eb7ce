/* SPDX-License-Identifier: MIT */
/* png_read.h - reads PNG files of every kind into images, whole or band by band. */
#ifndef IMAGE_PNG_READ_H
#define IMAGE_PNG_READ_H

#include "image.h"

/* The default background of transparent pixels. */
#define IMAGE_WHITE ((image_color){255, 255, 255})

/* Read any PNG without loss. Palette images and greys of up to 8 bits become indexed images; all others become RGB,
 * with 16 bits a sample only if 8 cannot hold them. Transparent pixels are blended with white. Gamma and colour
 * profiles change no pixel; image.color_space holds their digest. Returns false, sets *error and zeroes the image for
 * files that are not regular, truncated or fail a checksum, for sides beyond IMAGE_MAX_SIDE, and for more pixels than a
 * file of this size can encode. Memory: at most 8 bytes a pixel and 8300 times the file's size, beside libpng's row and
 * a chunk of at most 8 MB. */
bool image_read_png(const char *path, image *image, octreel_error *error);

/* Read a PNG over a given background. */
bool image_read_png_over(const char *path, image_color background, image *image, octreel_error *error);

/* A PNG file whose rows are decoded on demand, so that the picture is never in memory as a whole. All rows are read at
 * opening if `whole` is set, if the file is interlaced, or if it has 16 bits a sample. Not thread-safe. */
typedef struct image_source image_source;

/* Open a file under the rules of image_read_png(). Returns null and sets *error on failure. `path` and `error` must
 * outlive the source. */
image_source *image_source_open(const char *path, image_color background, bool whole, octreel_error *error);
void image_source_close(image_source *source); /* null is allowed */

/* Returns the description of the image; its pixels are null unless all rows are in memory. */
const image *image_source_description(const image_source *source);

/* Read the next rows, at most `rows`, as an image that must not be released: its pixels belong to the source and are
 * valid until the next call. Returns false after the last row, and false with *error set if reading fails. The end of
 * the file is checked before the last rows are returned. */
bool image_source_read_band(image_source *source, int rows, image *band);
bool image_source_has_failed(const image_source *source);

/* Returns the number of rows to read at a time: several bands of this height fit the L2 cache, and the cost per band is
 * small. */
static inline int image_find_band_height(const image *about)
{
    enum { BAND_PIXELS = 1 << 14 };
    return about->width < BAND_PIXELS ? BAND_PIXELS / about->width : 1;
}

#endif
