/* SPDX-License-Identifier: MIT */
/* png_write.h - pictures to PNG files, which are written completely or not at all. */
#ifndef IMAGE_PNG_WRITE_H
#define IMAGE_PNG_WRITE_H

#include "image.h"

/* A keyword and its text, written as tEXt chunks in the order given. Keywords and texts are Latin-1. */
typedef struct image_text {
    const char *keyword; /* 1 to 79 characters */
    const char *text;
} image_text;

/* Write a PNG as a file_writer does. Indexed images become 8-bit palette PNGs of exactly palette.count colours, RGB
 * ones 8-bit RGB; no row is filtered, and deflate.h packs them. No dates: the same image and texts make the same bytes
 * on every machine. An index beyond the palette or a keyword that PNG does not allow is an error. When it fails, no
 * .part file of this call is left, and a file that was at `path` before is unharmed. */
bool image_write_png(const image *image, const char *path, const image_text *texts, size_t text_count,
                     octreel_error *error);

/* A picture that is produced while it is written, so that it is never in memory as a whole. */
typedef struct image_rows {
    int width, height;            /* at least 1; PNG readers may refuse what is larger than IMAGE_MAX_SIDE */
    const image_palette *palette; /* of one byte a pixel, whose indices all have a colour; null: r, g, b */
    const uint8_t *(*row)(int y, void *context); /* asked for from the top down; stays valid until the next one */
    void *context;
} image_rows;

/* Write it as image_write_png() does. */
bool image_write_png_rows(const image_rows *rows, const char *path, octreel_error *error);

/* The libraries that write the files, and their versions at run time. Returns `text`. */
#define IMAGE_LIBRARY_TEXT 64
char *image_library(char text[IMAGE_LIBRARY_TEXT]);

#endif
