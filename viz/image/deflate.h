/* SPDX-License-Identifier: MIT */
/* deflate.h - the rows of a picture to a zlib stream (RFC 1950 and 1951), in one pass.
 *
 * It is made for pictures that are drawn: most of a row repeats the row above or is a run of one colour. The same rows
 * make the same bytes on every machine.
 */
#ifndef IMAGE_DEFLATE_H
#define IMAGE_DEFLATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Takes the next bytes of the stream. It may jump out of the encoder, which can then only be closed. */
typedef void deflate_sink(void *context, const uint8_t *bytes, size_t size);

typedef struct deflater deflater;

/* An encoder for so many rows of `row_size` bytes each, with 1 or 3 bytes a pixel. Null without memory: it takes 170 KB
 * and three rows. */
deflater *deflater_open(size_t row_size, size_t rows, size_t pixel, deflate_sink *sink, void *context);
void deflater_close(deflater *d); /* null is allowed */

/* The next row, as PNG has it: a zero, which says that it is not filtered, and row_size - 1 bytes of pixels. */
void deflater_add(deflater *d, const uint8_t *pixels);

/* After the last row, hand the rest of the stream to the sink. */
void deflater_finish(deflater *d);

#endif
