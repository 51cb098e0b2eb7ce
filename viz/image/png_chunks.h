/* SPDX-License-Identifier: MIT */
/* png_chunks.h - size and texts of PNG files, read chunk by chunk without decoding pixels. */
#ifndef IMAGE_PNG_CHUNKS_H
#define IMAGE_PNG_CHUNKS_H

#include <stdbool.h>
#include <stddef.h>

/* The sides of a picture whose file begins and ends as a PNG; false for any other file. */
bool image_png_size(const char *path, int *width, int *height);

/* Read the first tEXt chunk with this keyword, of those before the pixels and in the file's first 4096 bytes, into text
 * (cut at size - 1). False when there is none. */
bool image_read_text(const char *path, const char *keyword, char *text, size_t size);

/* Overwrite it with a text of the same length; nothing else in the file changes. The file stays valid even if the
 * process is killed. False when the file has no such text or cannot be written. */
bool image_replace_text(const char *path, const char *keyword, const char *text);

#endif
