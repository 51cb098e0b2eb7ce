/* SPDX-License-Identifier: MIT */
/* png_write.h - writes pictures to PNG files, whole or not at all. */
#ifndef IMAGE_PNG_WRITE_H
#define IMAGE_PNG_WRITE_H

#include "image.h"

/* A tEXt chunk. Chunks are written in the order given; keyword and text are Latin-1. */
typedef struct image_text {
    const char *keyword; /* 1 to 79 characters */
    const char *text;
} image_text;

/* Write a PNG, which appears by rename (see file_writer). An indexed image becomes a palette PNG with 8 bits a pixel
 * and exactly palette.count colours; an RGB image becomes 8-bit RGB. Rows are not filtered; deflate.h compresses them.
 * No dates: the same image and texts give the same bytes on every machine. Returns false and sets *error for an index
 * beyond the palette, a keyword that PNG does not allow, or a failed write. An existing file at `path` then stays
 * unchanged, and no .part file is left. */
bool image_write_png(const image *image, const char *path, const image_text *texts, size_t text_count,
                     octreel_error *error);

/* A picture whose rows are produced while they are written, so that it is never in memory as a whole. */
typedef struct image_rows {
    int width, height;            /* at least 1; some PNG readers refuse sides above IMAGE_MAX_SIDE */
    const image_palette *palette; /* rows hold valid indices, one byte a pixel; null: rows hold r, g, b */
    const uint8_t *(*row)(int y,
                          void *context); /* called from the top row down; its result is valid until the next call */
    void *context;
} image_rows;

/* Write it as image_write_png() does. */
bool image_write_png_rows(const image_rows *rows, const char *path, octreel_error *error);

/* Print the versions, at run time, of the libraries that write PNG files. Returns `text`. */
#define IMAGE_LIBRARY_TEXT 64
char *image_print_library_versions(char text[IMAGE_LIBRARY_TEXT]);

#endif
