/* SPDX-License-Identifier: MIT */
/* png_by_hand.h - writes and parses PNG files chunk by chunk, with zlib but without libpng, to check libpng's output.
 */
#ifndef PNG_BY_HAND_H
#define PNG_BY_HAND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The bytes of a file that was loaded or is being built. */
typedef struct png_bytes {
    uint8_t data[1 << 16];
    size_t size;
} png_bytes;

void png_bytes_put(png_bytes *out, const void *data, size_t size);
void png_bytes_save(const png_bytes *file, size_t size, const char *path);
void png_bytes_load(png_bytes *file, const char *path);

/* Begin a file: signature and IHDR. */
void png_put_header(png_bytes *out, uint32_t width, uint32_t height, int depth, int color_type, bool interlaced);

void png_put_chunk(png_bytes *out, const char *type, const void *data, size_t size);

/* One IDAT with these rows (filter bytes included), and IEND. */
void png_put_rows_and_end(png_bytes *out, const png_bytes *rows);

/* One chunk of a file: its type, its data and the offset of the next one. */
typedef struct png_chunk {
    char type[5];
    const uint8_t *data;
    uint32_t size;
    size_t next;
} png_chunk;

/* The chunk at an offset; the test fails if the chunk is not whole or its CRC is wrong. The first chunk is at 8. */
png_chunk png_chunk_at(const png_bytes *file, size_t at);

/* The first chunk of a type; the test fails when there is none. */
png_chunk png_chunk_of(const png_bytes *file, const char *type);

uint32_t png_u32_at(const uint8_t *at);

#endif
