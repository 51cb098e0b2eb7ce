/* image.c - an image in memory: its pixels and their colours. */
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
