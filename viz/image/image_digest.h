/* SPDX-License-Identifier: MIT */
/* image_digest.h - one number for the size and the colours of a picture. */
#ifndef IMAGE_IMAGE_DIGEST_H
#define IMAGE_IMAGE_DIGEST_H

#include "image.h"

/* A digest of size and colours (not of how they are stored): equal for an indexed image and its RGB twin. */
uint64_t image_digest(const image *image);

/* The same of a PNG as image_read_png_over() reads it, row by row. `about` is the image without pixels. */
bool image_digest_png(const char *path, image_color background, image *about, uint64_t *digest, octreel_error *error);

#endif
