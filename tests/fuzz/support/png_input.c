/* SPDX-License-Identifier: MIT */
#undef _POSIX_C_SOURCE
#define _GNU_SOURCE /* for memfd_create() */
#include "png_input.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

static uint32_t read_u32(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static void write_u32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> (24 - 8 * i));
}

static void repair_checksums(png_input *f)
{
    for (size_t at = 8; at + 12 <= f->size;) {
        const uint32_t length = read_u32(f->bytes + at);
        if (length > f->size - at - 12)
            return;
        write_u32(f->bytes + at + 8 + length, (uint32_t)crc32(0, f->bytes + at + 4, length + 4));
        at += 12 + (size_t)length;
    }
}

static void put_chunk(png_input *f, const char *type, const uint8_t *data, size_t size)
{
    uint8_t *at = f->bytes + f->size;
    write_u32(at, (uint32_t)size);
    memcpy(at + 4, type, 4);
    if (size > 0)
        memcpy(at + 8, data, size);
    write_u32(at + 8 + size, (uint32_t)crc32(0, at + 4, (uInt)(size + 4)));
    f->size += size + 12;
}

/* A recipe: kind, sides, number of colours and of alphas, these values, and then rows with their filter bytes. */
static void follow_recipe(png_input *f, const uint8_t *data, size_t size)
{
    static const uint8_t kinds[][2] = {{0, 1}, {0, 2}, {0, 4}, {0, 8}, {0, 16}, {2, 8}, {2, 16}, {3, 1},
                                       {3, 2}, {3, 4}, {3, 8}, {4, 8}, {4, 16}, {6, 8}, {6, 16}};
    enum { HEAD = 6, KINDS = sizeof kinds / sizeof kinds[0] };
    if (size < HEAD)
        return;
    const uint8_t *kind = kinds[data[0] % KINDS], *rest = data + HEAD;
    size_t left = size - HEAD;
    const size_t colors = 3u * data[4] < left ? 3u * data[4] : left;
    const size_t alphas = data[5] < left - colors ? data[5] : left - colors;
    const uint8_t header[13] = {0, 0, 0, data[1], 0, 0, 0, data[2], kind[1], kind[0], 0, 0, data[3] & 1};
    static uint8_t packed[PNG_INPUT_MOST];
    uLongf packed_size = sizeof packed;
    memcpy(f->bytes, "\x89PNG\r\n\x1a\n", 8);
    f->size = 8;
    put_chunk(f, "IHDR", header, sizeof header);
    if (colors > 0)
        put_chunk(f, "PLTE", rest, colors);
    if (alphas > 0)
        put_chunk(f, "tRNS", rest + colors, alphas);
    if (compress(packed, &packed_size, rest + colors + alphas, left - colors - alphas) == Z_OK)
        put_chunk(f, "IDAT", packed, packed_size);
    put_chunk(f, "IEND", NULL, 0);
}

void png_input_make(png_input *f, const uint8_t *data, size_t size)
{
    f->size = 0;
    if (data[0] % PNG_INPUT_MODES == PNG_INPUT_RECIPE) {
        follow_recipe(f, data + 1, size - 1);
        return;
    }
    memcpy(f->bytes, data + 1, size - 1);
    f->size = size - 1;
    if (data[0] % PNG_INPUT_MODES == PNG_INPUT_WITH_CHECKSUMS)
        repair_checksums(f);
}

const char *png_input_save(const png_input *f)
{
    static int memory = -1;
    static char path[40];
    if (memory < 0)
        memory = memfd_create("fuzz", 0);
    snprintf(path, sizeof path, "/proc/self/fd/%d", memory);
    if (memory < 0 || ftruncate(memory, 0) != 0 || pwrite(memory, f->bytes, f->size, 0) != (ssize_t)f->size)
        abort();
    return path;
}
