/* SPDX-License-Identifier: MIT */
/* stored_png.c - see stored_png.h. */
#include "stored_png.h"
#include "images.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

static uint64_t next_random(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return *state >> 33;
}

png_storage png_storage_at(int i)
{
    static const int stored[][2] = {{0, 1}, {0, 2}, {0, 4}, {0, 8}, {0, 16}, {2, 8}, {2, 16}, {3, 1},
                                    {3, 2}, {3, 4}, {3, 8}, {4, 8}, {4, 16}, {6, 8}, {6, 16}};
    int n = 0;
    for (int kind = 0; kind < 15; kind++) {
        for (int variant = 0; variant < 8; variant++) {
            const png_storage s = {stored[kind][0], stored[kind][1], variant & 1, variant & 2, variant & 4};
            if ((s.keyed && s.color_type >= 4) || (s.narrow && s.depth < 16))
                continue;
            if (n++ == i)
                return s;
        }
    }
    fail_msg("there are %d kinds of storage, not %d", n, PNG_STORAGES);
    return (png_storage){0};
}

static size_t row_size(const stored_png *p)
{
    static const int samples[] = {1, 0, 3, 1, 2, 0, 4};
    return ((size_t)p->width * (size_t)(samples[p->storage.color_type] * p->storage.depth) + 7) / 8;
}

/* Any bytes are a picture: of palettes, all indices have colours. */
static uint8_t *make_rows(const stored_png *p)
{
    const size_t size = row_size(p) * (size_t)p->height, step = p->storage.depth == 16 ? 2 : 1;
    uint64_t random = p->seed, spoiling = p->spoiling_seed;
    uint8_t colors[8], *rows = malloc(size + 1);
    assert_non_null(rows);
    for (int i = 0; i < 8; i++)
        colors[i] = (uint8_t)next_random(&random);
    for (size_t i = 0; i < size; i++)
        rows[i] = colors[(i % row_size(p) / 24 + i / row_size(p) / 5 + p->seed) % 8];
    for (int i = 0; i < p->spoiled; i++)
        rows[next_random(&spoiling) % size] = (uint8_t)next_random(&spoiling);
    for (size_t i = 0; p->storage.narrow && i + 1 < size; i += step)
        rows[i + 1] = rows[i];
    return rows;
}

static void put_colors(png_structp png, png_infop info, const stored_png *p)
{
    png_byte alphas[3] = {0, 100, 200};
    png_color colors[256];
    png_color_16 key = {.red = 7, .green = 7, .blue = 7, .gray = 1};
    const int count = 1 << (p->storage.depth < 8 ? p->storage.depth : 8);
    uint64_t random = p->seed / 2;
    for (int i = 0; i < count; i++)
        colors[i] = (png_color){(png_byte)next_random(&random), (png_byte)next_random(&random), (png_byte)(i / 2)};
    if (p->storage.color_type == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, colors, count);
    if (p->storage.keyed)
        png_set_tRNS(png, info, alphas, count < 3 ? count : 3, &key);
}

void stored_png_save(const stored_png *p, const char *path)
{
    uint8_t *rows = make_rows(p);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    assert_non_null(info);
    if (setjmp(png_jmpbuf(png)) != 0)
        fail_msg("libpng cannot write %s", path);
    png_init_io(png, file);
    png_set_compression_level(png, 1);
    png_set_IHDR(png, info, (png_uint_32)p->width, (png_uint_32)p->height, p->storage.depth, p->storage.color_type,
                 p->storage.interlaced, 0, 0);
    put_colors(png, info, p);
    png_write_info(png, info);
    const int passes = png_set_interlace_handling(png);
    for (int pass = 0; pass < passes; pass++)
        for (int y = 0; y < p->height; y++)
            png_write_row(png, rows + (size_t)y * row_size(p));
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    assert_int_equal(fclose(file), 0);
    free(rows);
}
