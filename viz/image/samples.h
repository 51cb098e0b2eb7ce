/* SPDX-License-Identifier: MIT */
/* samples.h - reads the pixels of an image as red, green and blue, whatever the image's format. */
#ifndef IMAGE_SAMPLES_H
#define IMAGE_SAMPLES_H

#include "image.h"

/* The red, green and blue samples of a pixel, of 8 or 16 bits each. */
typedef struct pixel_samples {
    uint16_t of[3];
} pixel_samples;

/* Returns the largest sample value after scaling both images to the same range: 255 or 65535. */
int common_sample_range(const image *a, const image *b);

/* Read `count` pixels from the n-th pixel on, and scale their samples to 0..range. */
void read_samples(const image *image, size_t n, int count, int range, pixel_samples *span);

#endif
