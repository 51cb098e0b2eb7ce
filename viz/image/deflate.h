/* SPDX-License-Identifier: MIT */
/* deflate.h - compresses the rows of a picture into a zlib stream (RFC 1950 and 1951) in one pass.
 *
 * The encoder is tuned for drawn pictures: most of a row repeats the row above or is a run of one colour. The same rows
 * produce the same bytes on every machine. */
#ifndef IMAGE_DEFLATE_H
#define IMAGE_DEFLATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A function that receives the next bytes of the stream. The function may leave by longjmp(); the caller must then
 * close the encoder without using it further. */
typedef void deflate_sink(void *context, const uint8_t *bytes, size_t size);

typedef struct deflater deflater;

/* Create an encoder for `rows` rows of `row_size` bytes each, with `pixel` bytes (1 or 3) per pixel. The encoder needs
 * memory for 300 KB and two rows. Returns null if memory runs out. */
deflater *deflater_open(size_t row_size, size_t rows, size_t pixel, deflate_sink *sink, void *context);
void deflater_close(deflater *d); /* `d` may be null */

/* Append the next row: row_size - 1 bytes of pixels. In the stream, the row begins with its PNG filter, which the
 * encoder chooses by the rows so far: 0 (none) or, only in RGB pictures, 1 (Sub). */
void deflater_add_row(deflater *d, const uint8_t *pixels);

/* Pass the rest of the stream to the sink. Must be called after the last row. */
void deflater_finish(deflater *d);

#endif
