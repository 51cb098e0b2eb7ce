/* SPDX-License-Identifier: MIT */
/* compare_pixels.h - turns the pixels of a caller into an image. */
#ifndef COMPARE_COMPARE_PIXELS_H
#define COMPARE_COMPARE_PIXELS_H

#include "image.h"
#include "octreel/compare.h"

/* Describe the pixels as an image. If an image can have the pixels as they are, it points to them, and *owned is null;
 * else *owned is a converted copy, which the caller frees. Return false with an error if the pixels are invalid or
 * memory runs out. `which` names the picture in errors. */
bool pixels_to_image(const octreel_pixels *pixels, const char *which, image_color background, image *image,
                     uint8_t **owned, octreel_error *error);

#endif
