/* SPDX-License-Identifier: MIT */
#include "image.h"

#include <stdlib.h>
#include <string.h>

bool image_create(image *image, int width, int height, int channels)
{
    memset(image, 0, sizeof *image);
    if (width < 1 || width > IMAGE_MAX_SIDE || height < 1 || height > IMAGE_MAX_SIDE)
        return false;
    if (channels != 1 && channels != 3)
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

bool image_has_colors(const image *image)
{
    const size_t size = (size_t)image->width * (size_t)image->height;
    uint8_t largest = 0;
    for (size_t i = 0; i < size; i++)
        largest = image->pixels[i] > largest ? image->pixels[i] : largest;
    return largest < image->palette.count;
}

static uint8_t narrow(uint16_t sample)
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
    return (image_color){narrow(samples[0]), narrow(samples[1]), narrow(samples[2])};
}

/* ---- Fewer pixels ------------------------------------------------------------------------------------------- */

/* One block of samples, whose first is at `at`. */
typedef struct block {
    const uint8_t *at;
    size_t row; /* samples from one row to the next */
    int side;
} block;

/* Most blocks are of one colour. */
static bool is_flat(const block *b)
{
    for (int y = 0; y < b->side; y++)
        for (int x = 0; x < b->side; x++)
            if (b->at[(size_t)y * b->row + (size_t)x] != *b->at)
                return false;
    return true;
}

static image_color mean_of(const block *b, const image_palette *palette)
{
    const unsigned count = (unsigned)(b->side * b->side);
    unsigned sums[3] = {count / 2, count / 2, count / 2}; /* to the nearest */
    for (int y = 0; y < b->side; y++) {
        for (int x = 0; x < b->side; x++) {
            const image_color *color = &palette->colors[b->at[(size_t)y * b->row + (size_t)x]];
            sums[0] += color->r;
            sums[1] += color->g;
            sums[2] += color->b;
        }
    }
    return (image_color){(uint8_t)(sums[0] / count), (uint8_t)(sums[1] / count), (uint8_t)(sums[2] / count)};
}

bool image_shrink(const image *from, int factor, image *small)
{
    if (factor < 1 || factor > 16 || from->channels != 1 || small->channels != 3 ||
        from->width != small->width * factor || from->height != small->height * factor)
        return false;
    block b = {.row = (size_t)from->width, .side = factor};
    uint8_t *out = small->pixels;
    for (int y = 0; y < small->height; y++) {
        b.at = from->pixels + (size_t)y * (size_t)factor * b.row;
        for (int x = 0; x < small->width; x++, b.at += factor, out += 3) {
            const image_color color = is_flat(&b) ? from->palette.colors[*b.at] : mean_of(&b, &from->palette);
            out[0] = color.r;
            out[1] = color.g;
            out[2] = color.b;
        }
    }
    return true;
}
