/* SPDX-License-Identifier: MIT */
/* image.h - a picture in memory. Knows neither GL nor trees.
 *
 * An image is either indexed (one byte a pixel into a palette) or RGB (three samples a pixel, of 8 bits or, when it was
 * read from such a file, of 16), rows from the top down, without padding.
 */
#ifndef IMAGE_IMAGE_H
#define IMAGE_IMAGE_H

#include "error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A side of a picture that this program draws or reads is at most this many pixels. */
#define IMAGE_MAX_SIDE 16384

typedef struct image_color {
    uint8_t r, g, b;
} image_color;

typedef struct image_palette {
    image_color colors[256]; /* entries from count on are unused and must be zero */
    int count;               /* 1 to 256 */
} image_palette;

typedef struct image {
    int width, height;
    int channels;          /* 1: indices into the palette; 3: r, g, b */
    bool wide;             /* a sample has 16 bits, in this machine's byte order, not 8; channels is then 3 */
    bool transparent;      /* the file that it was read from has transparent pixels: they were laid over a background */
    uint64_t color_space;  /* a digest of what its file says of the meaning of samples, which no pixel here depends on:
                              gamma, profiles and the like; 0: nothing */
    image_palette palette; /* read when channels is 1 */
    uint8_t *pixels;       /* width * height * image_pixel_size() bytes, owned */
} image;

/* Bytes of a pixel: 1, 3 or 6. */
static inline size_t image_pixel_size(const image *image)
{
    return (size_t)image->channels * (image->wide ? 2 : 1);
}

/* Allocate the pixels, all zero; the palette is zeroed too. False, and the image zeroed, when there is no memory, a
 * side is outside 1..IMAGE_MAX_SIDE, or channels is neither 1 nor 3. */
bool image_create(image *image, int width, int height, int channels);
/* Free the pixels and zero the image; a zeroed image is allowed. */
void image_release(image *image);

/* The colour of a pixel inside the image; of 16 bits a sample to the nearest of 8. */
image_color image_color_at(const image *image, int x, int y);

/* Whether each pixel of an indexed image has a colour in its palette. */
bool image_has_colors(const image *image);

/* Fill an RGB image from an indexed one whose sides are `factor` times (1 to 16) as long: each pixel is the mean of
 * factor * factor, rounded to the nearest. Where an index is beyond the palette, the colour is that of `own`, r, g, b a
 * pixel of `from`; null where there is none such. False, and nothing done, when the two do not fit together so. */
bool image_shrink(const image *from, const uint8_t *own, int factor, image *small);

#endif
