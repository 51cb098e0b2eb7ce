/* png_read.h - PNG files of every kind to images: whole, or row by row. */
#ifndef IMAGE_PNG_READ_H
#define IMAGE_PNG_READ_H

#include "image.h"

/* What shines through where a picture is transparent, unless another colour is asked for. */
#define IMAGE_WHITE ((image_color){255, 255, 255})

/* Read any PNG without loss: palettes, and greys of up to 8 bits, become indexed images, the others RGB ones, with 16
 * bits a sample only where 8 cannot hold them. What is transparent is laid over white; gamma and colour profiles are
 * ignored. Refused are files that are no regular files, whatever is cut short or fails a checksum, sides beyond
 * IMAGE_MAX_SIDE, and more pixels than so many compressed bytes can hold: memory stays within 8 bytes a pixel, and
 * within 8300 times the file's size. The image is created; when it fails, it is zeroed. */
bool image_read_png(const char *path, image *image, octreel_error *error);

/* The same over a background of one's own. */
bool image_read_png_over(const char *path, image_color background, image *image, octreel_error *error);

/* The rows of a PNG, decoded as they are asked for, so that it never is in memory whole. Where rows cannot come one
 * after the other - they are interlaced, or have 16 bits a sample and may not need them - all are read when it is
 * opened, as they are when `whole` asks for it. One thread at a time may use it. */
typedef struct image_source image_source;

/* Begin, under the rules of image_read_png(). Null, with a sentence, where that cannot be; path and error must outlive
 * the source. */
image_source *image_source_open(const char *path, image_color background, bool whole, octreel_error *error);
void image_source_close(image_source *source); /* null is allowed */

/* The image but for its pixels, which are null unless all of them are at hand. */
const image *image_source_about(const image_source *source);

/* The next rows, at most `rows`, as an image that is not to be released: its pixels belong to the source, and are valid
 * until the next call. False after the last row, or, with a sentence, when reading fails. The end of the file is
 * checked before its last rows are returned. */
bool image_source_next(image_source *source, int rows, image *band);
bool image_source_failed(const image_source *source);

/* How many rows of a picture are best asked for at a time: so few that some such bands fit the second cache, and so
 * many that what is done for each band does not count. */
static inline int image_band_rows(const image *about)
{
    enum { BAND_PIXELS = 1 << 14 };
    return about->width < BAND_PIXELS ? BAND_PIXELS / about->width : 1;
}

#endif
