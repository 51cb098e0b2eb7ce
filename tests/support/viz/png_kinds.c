/* SPDX-License-Identifier: MIT */
#include "png_kinds.h"

int png_samples_per_pixel(int color_type)
{
    static const int samples[] = {[PNG_KIND_GREY] = 1,
                                  [PNG_KIND_RGB] = 3,
                                  [PNG_KIND_PALETTE] = 1,
                                  [PNG_KIND_GREY_ALPHA] = 2,
                                  [PNG_KIND_RGB_ALPHA] = 4};
    return samples[color_type];
}

unsigned png_largest_sample(png_kind kind)
{
    return (1u << kind.depth) - 1;
}

unsigned png_sample_at(png_kind kind, int x, int y, int sample)
{
    unsigned mixed = (unsigned)(x * 40503 + y * 2654435 + sample * 977) * 2654435761u >> 16;
    if ((x + y) % 5 == 0)
        return 0;
    if ((x + y) % 5 == 1)
        return png_largest_sample(kind);
    return mixed & png_largest_sample(kind);
}

image_color png_palette_color(unsigned index)
{
    return (image_color){(uint8_t)(index * 11), (uint8_t)(255 - index), (uint8_t)(index * 101)};
}

uint8_t png_palette_alpha(unsigned index)
{
    static const uint8_t alphas[PNG_KIND_PALETTE_ALPHAS] = {0, 100};
    return index < PNG_KIND_PALETTE_ALPHAS ? alphas[index] : 255;
}

static void put_row(png_bytes *rows, png_kind kind, int y, int first_x, int step_x)
{
    static const uint8_t filter_none = 0;
    png_bytes_put(rows, &filter_none, 1);
    unsigned bits = 0, bit_count = 0;
    for (int x = first_x; x < PNG_KIND_SIDE; x += step_x) {
        for (int sample = 0; sample < png_samples_per_pixel(kind.color_type); sample++) {
            bits = bits << kind.depth | png_sample_at(kind, x, y, sample);
            bit_count += (unsigned)kind.depth;
            for (; bit_count >= 8; bit_count -= 8)
                png_bytes_put(rows, &(uint8_t){(uint8_t)(bits >> (bit_count - 8))}, 1);
        }
    }
    if (bit_count > 0)
        png_bytes_put(rows, &(uint8_t){(uint8_t)(bits << (8 - bit_count))}, 1);
}

static void put_all_rows(png_bytes *rows, png_kind kind)
{
    static const int whole[][4] = {{0, 0, 1, 1}}; /* first x, first y, step x, step y */
    static const int adam7[][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                   {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
    const int(*passes)[4] = kind.interlaced ? adam7 : whole;
    int count = kind.interlaced ? 7 : 1;
    for (int i = 0; i < count; i++) {
        for (int y = passes[i][1]; y < PNG_KIND_SIDE; y += passes[i][3])
            put_row(rows, kind, y, passes[i][0], passes[i][2]);
    }
}

/* tRNS: the first two alphas of a palette, or the colour of pixel (3, 0) as the one that is clear. */
static void put_key(png_bytes *out, png_kind kind)
{
    uint8_t data[6];
    size_t size = PNG_KIND_PALETTE_ALPHAS;
    if (kind.color_type == PNG_KIND_PALETTE) {
        for (unsigned i = 0; i < PNG_KIND_PALETTE_ALPHAS; i++)
            data[i] = png_palette_alpha(i);
    } else {
        size = 2 * (size_t)png_samples_per_pixel(kind.color_type);
        for (size_t i = 0; i < size; i++)
            data[i] = (uint8_t)(png_sample_at(kind, 3, 0, (int)i / 2) >> (i % 2 == 0 ? 8 : 0));
    }
    png_put_chunk(out, "tRNS", data, size);
}

void png_make_kind(png_bytes *out, png_kind kind)
{
    png_bytes rows = {.size = 0};
    png_put_header(out, PNG_KIND_SIDE, PNG_KIND_SIDE, kind.depth, kind.color_type, kind.interlaced);
    png_put_chunk(out, "gAMA", "\0\0\x40\0", 4); /* must not change a pixel */
    if (kind.color_type == PNG_KIND_PALETTE) {
        png_bytes palette = {.size = 0};
        for (unsigned i = 0; i <= png_largest_sample(kind); i++) {
            image_color color = png_palette_color(i);
            png_bytes_put(&palette, &color, 3);
        }
        png_put_chunk(out, "PLTE", palette.data, palette.size);
    }
    if (kind.keyed)
        put_key(out, kind);
    put_all_rows(&rows, kind);
    png_put_rows_and_end(out, &rows);
}

void png_for_every_kind(void (*visit)(const char *path, png_kind kind), const char *path)
{
    static const int stored[][2] = {{PNG_KIND_GREY, 1},        {PNG_KIND_GREY, 2},      {PNG_KIND_GREY, 4},
                                    {PNG_KIND_GREY, 8},        {PNG_KIND_GREY, 16},     {PNG_KIND_RGB, 8},
                                    {PNG_KIND_RGB, 16},        {PNG_KIND_PALETTE, 1},   {PNG_KIND_PALETTE, 2},
                                    {PNG_KIND_PALETTE, 4},     {PNG_KIND_PALETTE, 8},   {PNG_KIND_GREY_ALPHA, 8},
                                    {PNG_KIND_GREY_ALPHA, 16}, {PNG_KIND_RGB_ALPHA, 8}, {PNG_KIND_RGB_ALPHA, 16}};
    for (size_t i = 0; i < sizeof stored / sizeof stored[0]; i++) {
        for (int variant = 0; variant < 4; variant++) {
            png_kind kind = {stored[i][0], stored[i][1], variant % 2 == 1, variant / 2 == 1};
            if (kind.keyed && kind.color_type >= PNG_KIND_GREY_ALPHA)
                continue;
            png_bytes file;
            png_make_kind(&file, kind);
            png_bytes_save(&file, file.size, path);
            visit(path, kind);
        }
    }
}
