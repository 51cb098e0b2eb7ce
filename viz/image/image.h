/* SPDX-License-Identifier: MIT */
/* image.h - a picture in memory.
 *
 * An image is either indexed or RGB. An indexed image has one byte per pixel, an index into its palette. An RGB image
 * has three samples per pixel, of 8 bits each, or of 16 bits if it was read from a file with 16 bits per sample. Rows
 * run from the top down, without padding. */
#ifndef IMAGE_IMAGE_H
#define IMAGE_IMAGE_H

#include "error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* The longest side, in pixels, of a picture that Octreel draws or reads. */
#define IMAGE_MAX_SIDE 16384

typedef struct image_color {
    uint8_t r, g, b;
} image_color;

typedef struct image_palette {
    image_color colors[256]; /* entries from index `count` on are not used and must be zero */
    int count;               /* number of colours, 1 to 256 */
} image_palette;

typedef struct image {
    int width, height;
    int channels;     /* 1: a pixel is an index into the palette; 3: a pixel has the samples r, g, b */
    bool wide;        /* true: samples have 16 bits in the machine's byte order; only if channels is 3 */
    bool transparent; /* true: the file had transparent pixels, which were blended with a background colour */
    /* digest of the file's chunks for gamma, colour profile and the like; 0: no such chunks. Octreel does not apply
     * these chunks */
    uint64_t color_space;
    image_palette palette; /* used only if channels is 1 */
    uint8_t *pixels;       /* owned by the image; size in bytes: width * height * image_pixel_size() */
} image;

/* Returns the number of bytes per pixel: 1, 3 or 6. */
static inline size_t image_pixel_size(const image *image)
{
    return (size_t)image->channels * (image->wide ? 2 : 1);
}

/* Allocate the pixels. Set the pixels and the palette to zero. Returns false and a zeroed image if memory runs out, if
 * a side is outside 1..IMAGE_MAX_SIDE, or if channels is neither 1 nor 3. */
bool image_create(image *image, int width, int height, int channels);
/* Free the pixels and zero the struct. The struct may be zeroed already. */
void image_release(image *image);

/* Returns the colour of the pixel (x, y), which must be inside the image. Samples of 16 bits are rounded to 8. */
image_color image_color_at(const image *image, int x, int y);

/* Set colors[x] to the colour of the pixel (x, y), for all x: faster than image_color_at() for each pixel. */
void image_read_row(const image *image, int y, image_color *colors);

/* Returns whether every index of an indexed image is inside its palette. */
bool image_has_valid_indices(const image *image);

/* Fill the RGB image `small` from an indexed image whose sides are `factor` (1 to 16) times as long. Each pixel of
 * `small` becomes the mean of factor * factor pixels, rounded to nearest.
 *
 * A pixel whose index is beyond the palette takes its colour from `own`, which holds r, g, b for each pixel of `from`.
 * `own` may be null if no index is beyond the palette. Returns false and changes nothing if the sizes or formats do not
 * match. */
bool image_shrink(const image *from, const uint8_t *own, int factor, image *small);

#endif
