/* SPDX-License-Identifier: MIT */
/* image.c - allocates images, reads pixels, and shrinks supersampled images. */
#include "image.h"

#include <stdlib.h>
#include <string.h>

bool image_create(image *image, int width, int height, int channels)
{
    memset(image, 0, sizeof *image);
    if (width < 1 || width > IMAGE_MAX_SIDE || height < 1 || height > IMAGE_MAX_SIDE ||
        (channels != 1 && channels != 3))
        return false;
    image->pixels = calloc((size_t)width * (size_t)height, (size_t)channels);
    if (image->pixels == NULL)
        return false;
    image->width = width;
    image->height = height;
    image->channels = channels;
    return true;
}

void image_release(image *image)
{
    free(image->pixels);
    memset(image, 0, sizeof *image);
}

bool image_has_valid_indices(const image *image)
{
    const size_t size = (size_t)image->width * (size_t)image->height;
    uint8_t largest = 0;
    for (size_t i = 0; i < size; i++)
        largest = image->pixels[i] > largest ? image->pixels[i] : largest;
    return largest < image->palette.count;
}

static uint8_t round_sample_to_8_bits(uint16_t sample)
{
    return (uint8_t)((sample + 128u) / 257u);
}

image_color image_color_at(const image *image, int x, int y)
{
    const uint8_t *at = image->pixels + ((size_t)y * (size_t)image->width + (size_t)x) * image_pixel_size(image);
    if (image->channels == 1)
        return image->palette.colors[*at];
    if (!image->wide)
        return (image_color){at[0], at[1], at[2]};
    uint16_t samples[3];
    memcpy(samples, at, sizeof samples);
    return (image_color){round_sample_to_8_bits(samples[0]), round_sample_to_8_bits(samples[1]),
                         round_sample_to_8_bits(samples[2])};
}

void image_read_row(const image *image, int y, image_color *colors)
{
    const uint8_t *at = image->pixels + (size_t)y * (size_t)image->width * image_pixel_size(image);
    for (int x = 0; image->channels == 1 && x < image->width; x++)
        colors[x] = image->palette.colors[at[x]];
    if (image->channels == 3 && !image->wide)
        memcpy(colors, at, (size_t)image->width * sizeof *colors);
    for (int x = 0; image->wide && x < image->width; x++)
        colors[x] = image_color_at(image, x, y);
}

/* ---- Shrinking ---------------------------------------------------------------------------------------------- */

/* Returns whether all pixels of a square have the same palette colour. In this common case no mean must be computed. */
static bool has_one_color(const image *of, size_t corner, int side)
{
    const uint8_t *at = of->pixels + corner;
    if (*at >= of->palette.count)
        return side == 1;
    for (int y = 0; y < side; y++, at += of->width)
        for (int x = 0; x < side; x++)
            if (at[x] != of->pixels[corner])
                return false;
    return true;
}

static image_color pixel_color(const image *of, const uint8_t *own, size_t at)
{
    const uint8_t index = of->pixels[at];
    if (index < of->palette.count)
        return of->palette.colors[index];
    return (image_color){own[3 * at], own[3 * at + 1], own[3 * at + 2]};
}

/* Returns the mean colour of a square of pixels. `corner` is the index of its top left pixel. */
static image_color mean_color(const image *of, const uint8_t *own, size_t corner, int side)
{
    const unsigned count = (unsigned)(side * side);
    /* the sums begin with half of the divisor `count`, so that the divisions round to nearest */
    unsigned sums[3] = {count / 2, count / 2, count / 2};
    for (int y = 0; y < side; y++) {
        for (int x = 0; x < side; x++) {
            const image_color color = pixel_color(of, own, corner + (size_t)y * (size_t)of->width + (size_t)x);
            sums[0] += color.r;
            sums[1] += color.g;
            sums[2] += color.b;
        }
    }
    return (image_color){(uint8_t)(sums[0] / count), (uint8_t)(sums[1] / count), (uint8_t)(sums[2] / count)};
}

/* The factor is 1: nothing is shrunk, and only the colours of the pixels are found. */
static void find_pixel_colors(const image *from, const uint8_t *own, uint8_t *out)
{
    const size_t count = (size_t)from->width * (size_t)from->height;
    const uint8_t *indices = from->pixels;
    for (size_t i = 0; i < count; i++, out += 3) {
        const uint8_t index = indices[i];
        const void *color = index < from->palette.count ? (const void *)&from->palette.colors[index] : own + 3 * i;
        memcpy(out, color, sizeof(image_color));
    }
}

bool image_shrink(const image *from, const uint8_t *own, int factor, image *small)
{
    if (factor < 1 || factor > 16 || from->channels != 1 || small->channels != 3 ||
        from->width != small->width * factor || from->height != small->height * factor)
        return false;
    uint8_t *out = small->pixels;
    if (factor == 1) {
        find_pixel_colors(from, own, out);
        return true;
    }
    for (int y = 0; y < small->height; y++) {
        size_t at = (size_t)y * (size_t)factor * (size_t)from->width;
        for (int x = 0; x < small->width; x++, at += (size_t)factor, out += 3) {
            const image_color color =
                has_one_color(from, at, factor) ? pixel_color(from, own, at) : mean_color(from, own, at, factor);
            memcpy(out, &color, sizeof color);
        }
    }
    return true;
}
