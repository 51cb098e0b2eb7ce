/* SPDX-License-Identifier: MIT */
/* png_write.h - writes pictures to PNG files. A file is written completely or not at all. */
#ifndef IMAGE_PNG_WRITE_H
#define IMAGE_PNG_WRITE_H

#include "image.h"

/* A tEXt chunk. Chunks are written in the order of the array. Keyword and text are in Latin-1. */
typedef struct image_text {
    const char *keyword; /* the chunk's keyword: 1 to 79 characters */
    const char *text;
} image_text;

/* Write a PNG file. The file appears at `path`, by a rename, when it is complete (see file_writer). An indexed image
 * becomes a palette PNG with 8 bits per pixel and exactly palette.count colours; an RGB image becomes an 8-bit RGB PNG.
 * deflate.h filters and compresses the rows. The file has no dates: the same image and texts give the same bytes
 * on every machine.
 *
 * Returns false and sets *error for an index beyond the palette, a keyword that PNG does not allow, or a failed write.
 * An existing file at `path` then stays unchanged, and no .part file is left. */
bool image_write_png(const image *image, const char *path, const image_text *texts, size_t text_count,
                     octreel_error *error);

/* A picture whose rows are produced while they are written, so that the whole picture need not be in memory. */
typedef struct image_rows {
    int width, height; /* sides in pixels, at least 1; some PNG readers refuse sides above IMAGE_MAX_SIDE */
    /* not null: a row holds one valid palette index per pixel; null: a row holds r, g, b per pixel */
    const image_palette *palette;
    /* called for each row from the top down; returns the row's pixels, which stay valid until the next call */
    const uint8_t *(*row)(int y, void *context);
    void *context;
} image_rows;

/* Write a picture under the rules of image_write_png(). */
bool image_write_png_rows(const image_rows *rows, const char *path, octreel_error *error);

/* Print the versions of the libraries that write PNG files, as found at run time. Returns `text`. */
#define IMAGE_LIBRARY_TEXT 64
char *image_print_library_versions(char text[IMAGE_LIBRARY_TEXT]);

#endif
