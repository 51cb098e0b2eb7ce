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

/* The colour of the n-th pixel in reading order. */
static image_color color_of(const image *image, size_t n)
{
    if (image->channels == 1)
        return image->palette.colors[image->pixels[n]];
    const uint8_t *at = image->pixels + 3 * n;
    return (image_color){at[0], at[1], at[2]};
}

image_color image_color_at(const image *image, int x, int y)
{
    return color_of(image, (size_t)y * (size_t)image->width + (size_t)x);
}

/* The end of the run of pixels stored as pixel `start` is. A frame is mostly background: eight bytes at a time are
 * compared with their own neighbours one pixel earlier. */
static size_t run_end(const image *image, size_t start, size_t pixel_count)
{
    size_t channels = (size_t)image->channels;
    size_t at = (start + 1) * channels;
    size_t size = pixel_count * channels;
    while (at + 8 <= size && memcmp(image->pixels + at, image->pixels + at - channels, 8) == 0)
        at += 8;
    while (at < size && image->pixels[at] == image->pixels[at - channels])
        at++;
    return at / channels;
}

static uint64_t digest_run(uint64_t digest, size_t length, uint64_t rgb)
{
    return length == 0 ? digest : octree_digest_word(digest, (uint64_t)length << 24 | rgb);
}

/* Runs of one colour, not pixels, are stirred in. Runs of unlike indices may have the same colour: these are joined,
 * so that the palette leaves no trace. */
uint64_t image_digest(const image *image)
{
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, (uint64_t)image->width);
    digest = octree_digest_word(digest, (uint64_t)image->height);
    size_t pixel_count = (size_t)image->width * (size_t)image->height;
    uint64_t rgb = 0;
    size_t length = 0;
    for (size_t at = 0, end; at < pixel_count; at = end) {
        end = run_end(image, at, pixel_count);
        image_color color = color_of(image, at);
        uint64_t next = (uint64_t)color.r << 16 | (uint64_t)color.g << 8 | color.b;
        if (next != rgb) {
            digest = digest_run(digest, length, rgb);
            rgb = next;
            length = 0;
        }
        length += end - at;
    }
    return digest_run(digest, length, rgb);
}
