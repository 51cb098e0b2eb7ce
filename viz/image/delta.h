/* delta.h - how far two colours are from each other for the eye. Private to this folder. */
#ifndef OCTREEL_IMAGE_DELTA_H
#define OCTREEL_IMAGE_DELTA_H

#include <stdint.h>

/* Red, green and blue of a pixel, 8 bits each or 16. */
typedef struct pixel_samples {
    uint16_t of[3];
} pixel_samples;

/* The square of the distance in IMAGE_DELTA_UNIT, of samples out of `range` (255 or 65535). Only sums and products of
 * doubles: the same on every machine. */
double delta_square(const pixel_samples *a, const pixel_samples *b, int range);

#endif
