/* SPDX-License-Identifier: MIT */
/* image_blend.c - blends transparent pixels with a background, and drops the low bytes of samples that 8 bits hold. */
#include "image_blend.h"

/* Blend a sample with the background. `alpha` ranges from 0 to `most`. */
static unsigned blend_sample(unsigned value, unsigned ground, unsigned alpha, unsigned most)
{
    return (value * alpha + ground * (most - alpha) + most / 2) / most;
}

image_color image_blend_color(image_color color, image_color ground, unsigned alpha)
{
    return (image_color){(uint8_t)blend_sample(color.r, ground.r, alpha, 255),
                         (uint8_t)blend_sample(color.g, ground.g, alpha, 255),
                         (uint8_t)blend_sample(color.b, ground.b, alpha, 255)};
}

enum { BLOCK = 8 };

static bool is_opaque_block(const uint8_t *at)
{
    return (at[3] & at[7] & at[11] & at[15] & at[19] & at[23] & at[27] & at[31]) == 255;
}

/* Most pixels are opaque, and BLOCK of them are packed at a time. Four bytes of each are copied, because this is faster
 * than three: the next pixel overwrites the fourth. */
void image_blend_pixels(uint8_t *pixels, size_t count, image_color ground)
{
    for (size_t n = 0; n < count;) {
        if (n + BLOCK <= count && is_opaque_block(pixels + 4 * n)) {
            for (const size_t end = n + BLOCK; n < end; n++)
                memmove(pixels + 3 * n, pixels + 4 * n, 4);
            continue;
        }
        const uint8_t *from = pixels + 4 * n;
        const image_color color = image_blend_color((image_color){from[0], from[1], from[2]}, ground, from[3]);
        memcpy(pixels + 3 * n++, &color, 3);
    }
}

/* Returns whether all of these 16-bit samples can be stored in 8 bits without loss. This is so if each sample is a
 * multiple of 257: its two bytes are then equal. */
static bool fits_8_bits(const uint8_t *samples, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (samples[2 * i] != samples[2 * i + 1])
            return false;
    return true;
}

void image_blend_wide_pixels(uint8_t *pixels, size_t count, image_color ground)
{
    const unsigned grounds[3] = {ground.r * 257u, ground.g * 257u, ground.b * 257u};
    for (size_t n = 0; n < count; n++) {
        uint16_t from[4], to[3];
        memcpy(from, pixels + n * sizeof from, sizeof from);
        const unsigned unit = fits_8_bits(pixels + n * sizeof from, 4) ? 257 : 1;
        for (size_t i = 0; i < 3; i++)
            to[i] = (uint16_t)(blend_sample(from[i] / unit, grounds[i] / unit, from[3] / unit, 65535 / unit) * unit);
        memcpy(pixels + n * sizeof to, to, sizeof to);
    }
}

void image_narrow_if_exact(image *band)
{
    const size_t count = 3 * (size_t)band->width * (size_t)band->height;
    if (!band->wide || !fits_8_bits(band->pixels, count))
        return;
    for (size_t i = 0; i < count; i++)
        band->pixels[i] = band->pixels[2 * i];
    band->wide = false;
}
