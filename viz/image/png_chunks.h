/* SPDX-License-Identifier: MIT */
/* png_chunks.h - reads the size and the texts of PNG files without decoding pixels, and replaces a text in place. */
#ifndef IMAGE_PNG_CHUNKS_H
#define IMAGE_PNG_CHUNKS_H

#include <stdbool.h>
#include <stddef.h>

/* Read the width and height of a file that begins and ends like a PNG. Returns false for any other file. */
bool image_read_png_size(const char *path, int *width, int *height);

/* Copy the text of the first tEXt chunk with this keyword to `text`, truncated to size - 1 characters. Only chunks
 * before the pixels and within the file's first 4096 bytes are searched. Returns false if there is none. */
bool image_read_text(const char *path, const char *keyword, char *text, size_t size);

/* Overwrite the text that image_read_text() would find with another of the same length. The file stays valid even if
 * the process is killed meanwhile. Returns false if there is no such text, the lengths differ, or the file cannot be
 * written. */
bool image_replace_text(const char *path, const char *keyword, const char *text);

#endif
