/* SPDX-License-Identifier: MIT */
/* png_chunks.h - reads the size and the texts of PNG files without decoding their pixels, and replaces a text in
 * place. */
#ifndef IMAGE_PNG_CHUNKS_H
#define IMAGE_PNG_CHUNKS_H

#include <stdbool.h>
#include <stddef.h>

/* Read the width and height of a PNG file. Returns false if the file does not begin and end like a PNG, or if a side is
 * not from 1 to IMAGE_MAX_SIDE. */
bool image_read_png_size(const char *path, int *width, int *height);

/* Copy the text of the first tEXt chunk with this keyword to `text`, truncated to size - 1 characters. Searches only
 * chunks before the pixels that lie in the file's first 4096 bytes. Returns false if there is no such chunk. */
bool image_read_text(const char *path, const char *keyword, char *text, size_t size);

/* Overwrite the text that image_read_text() would find with another text of the same length. The file stays valid even
 * if the process is killed during the call. Returns false if there is no such text, if the lengths differ, or if the
 * file cannot be written. */
bool image_replace_text(const char *path, const char *keyword, const char *text);

#endif
