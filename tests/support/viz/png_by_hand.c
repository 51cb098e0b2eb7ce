/* SPDX-License-Identifier: MIT */
/* png_by_hand.c - see png_by_hand.h. */
#include <setjmp.h>
#include <stdarg.h>
#include "png_by_hand.h"
#include <cmocka.h>

#include <stdio.h>
#include <string.h>
#include <zlib.h>

void png_bytes_put(png_bytes *out, const void *data, size_t size)
{
    assert_true(out->size + size <= sizeof out->data);
    if (size > 0)
        memcpy(out->data + out->size, data, size);
    out->size += size;
}

void png_bytes_save(const png_bytes *file, size_t size, const char *path)
{
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(file->data, 1, size, out), size);
    assert_int_equal(fclose(out), 0);
}

void png_bytes_load(png_bytes *file, const char *path)
{
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    file->size = fread(file->data, 1, sizeof file->data, in);
    assert_true(file->size < sizeof file->data);
    fclose(in);
}

static void put_u32(png_bytes *out, uint32_t value)
{
    uint8_t big[4] = {(uint8_t)(value >> 24), (uint8_t)(value >> 16), (uint8_t)(value >> 8), (uint8_t)value};
    png_bytes_put(out, big, 4);
}

uint32_t png_u32_at(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

void png_put_chunk(png_bytes *out, const char *type, const void *data, size_t size)
{
    put_u32(out, (uint32_t)size);
    size_t start = out->size;
    png_bytes_put(out, type, 4);
    png_bytes_put(out, data, size);
    put_u32(out, (uint32_t)crc32(0, out->data + start, (uInt)(size + 4)));
}

void png_put_header(png_bytes *out, uint32_t width, uint32_t height, int depth, int color_type, bool interlaced)
{
    out->size = 0;
    png_bytes_put(out, "\x89PNG\r\n\x1a\n", 8);
    uint8_t kinds[5] = {(uint8_t)depth, (uint8_t)color_type, 0, 0, interlaced};
    png_bytes header = {.size = 0};
    put_u32(&header, width);
    put_u32(&header, height);
    png_bytes_put(&header, kinds, sizeof kinds);
    png_put_chunk(out, "IHDR", header.data, header.size);
}

void png_put_rows_and_end(png_bytes *out, const png_bytes *rows)
{
    png_bytes packed;
    uLongf size = sizeof packed.data;
    assert_int_equal(compress(packed.data, &size, rows->data, rows->size), Z_OK);
    png_put_chunk(out, "IDAT", packed.data, size);
    png_put_chunk(out, "IEND", NULL, 0);
}

png_chunk png_chunk_at(const png_bytes *file, size_t at)
{
    assert_true(at + 12 <= file->size);
    png_chunk found = {.data = file->data + at + 8, .size = png_u32_at(file->data + at)};
    memcpy(found.type, file->data + at + 4, 4);
    found.next = at + 12 + found.size;
    assert_true(found.next <= file->size);
    assert_int_equal(crc32(0, file->data + at + 4, found.size + 4), png_u32_at(found.data + found.size));
    return found;
}

png_chunk png_chunk_of(const png_bytes *file, const char *type)
{
    png_chunk found = png_chunk_at(file, 8);
    while (strcmp(found.type, type) != 0)
        found = png_chunk_at(file, found.next);
    return found;
}
