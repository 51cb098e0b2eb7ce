/* SPDX-License-Identifier: MIT */
/* image_blend.h - converts decoded pixels to the formats of an image: blends transparent pixels with a background, and
 * drops the low bytes of 16-bit samples that 8 bits hold. */
#ifndef IMAGE_IMAGE_BLEND_H
#define IMAGE_IMAGE_BLEND_H

#include "image.h"

/* Blend a colour with a background. `alpha` ranges from 0 (transparent) to 255 (opaque). */
image_color image_blend_color(image_color color, image_color ground, unsigned alpha);

/* Blend `count` pixels with a background, in place: r, g, b, alpha become r, g, b. The samples have 8 bits, or for
 * image_blend_wide_pixels() 16 bits in the machine's byte order. If 8 bits hold all samples of a wide pixel, the
 * blended result is rounded to 8 bits. So a picture has the same colours whether it has 8 or 16 bits per sample. */
void image_blend_pixels(uint8_t *pixels, size_t count, image_color ground);
void image_blend_wide_pixels(uint8_t *pixels, size_t count, image_color ground);

/* Convert an image to 8 bits per sample if no precision is lost, so that equal pictures have the same format. */
void image_narrow_if_exact(image *band);

#endif
