/* image.c - an image in memory: its pixels, their colours and its digest. */
#include "image.h"

#include <stdlib.h>
#include <string.h>
#include "octree/digest.h"

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

/* The colour of the n-th pixel in reading order as one word: 8 bits a sample, or 16. */
static uint64_t color_word(const image *image, size_t n)
{
    const uint8_t *at = image->pixels + n * image_pixel_size(image);
    if (image->wide) {
        uint16_t samples[3];
        memcpy(samples, at, sizeof samples);
        return (uint64_t)samples[0] << 32 | (uint64_t)samples[1] << 16 | samples[2];
    }
    const image_color color = image->channels == 1 ? image->palette.colors[*at] : (image_color){at[0], at[1], at[2]};
    return (uint64_t)color.r << 16 | (uint64_t)color.g << 8 | color.b;
}

/* The end of the run of pixels stored as pixel `start` is. A frame is mostly background: eight bytes at a time are
 * compared with their own neighbours one pixel earlier. */
static size_t run_end(const image *image, size_t start, size_t pixel_count)
{
    const size_t step = image_pixel_size(image);
    size_t at = (start + 1) * step;
    size_t size = pixel_count * step;
    while (at + 8 <= size && memcmp(image->pixels + at, image->pixels + at - step, 8) == 0)
        at += 8;
    while (at < size && image->pixels[at] == image->pixels[at - step])
        at++;
    return at / step;
}

static uint64_t digest_run(uint64_t digest, size_t length, uint64_t color, bool wide)
{
    if (length == 0)
        return digest;
    if (wide)
        return octree_digest_word(octree_digest_word(digest, (uint64_t)length), color);
    return octree_digest_word(digest, (uint64_t)length << 24 | color);
}

/* Runs of one colour, not pixels, are stirred in. Runs of unlike indices may have the same colour: these are joined,
 * so that the palette leaves no trace. */
uint64_t image_digest(const image *image)
{
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, (uint64_t)image->width);
    digest = octree_digest_word(digest, (uint64_t)image->height);
    size_t pixel_count = (size_t)image->width * (size_t)image->height;
    uint64_t color = 0;
    size_t length = 0;
    for (size_t at = 0, end; at < pixel_count; at = end) {
        end = run_end(image, at, pixel_count);
        const uint64_t next = color_word(image, at);
        if (next != color) {
            digest = digest_run(digest, length, color, image->wide);
            color = next;
            length = 0;
        }
        length += end - at;
    }
    return digest_run(digest, length, color, image->wide);
}
