/* SPDX-License-Identifier: MIT */
/* flip.h - measures how visible the difference of two images is to a person who sees them in alternation. */
#ifndef IMAGE_FLIP_H
#define IMAGE_FLIP_H

#include "image_compare.h"

/* The resolution that a person sees, in pixels per degree of the visual field. The default is that of the authors: a
 * display of 3840 pixels and 0.7 m across, seen from 0.7 m, which is 3840 * pi / 180. */
#define FLIP_PIXELS_PER_DEGREE 67.020643276582256
#define FLIP_LEAST_PIXELS_PER_DEGREE 1
#define FLIP_MOST_PIXELS_PER_DEGREE 200

/* Measure FLIP between two images of the same size: the mean and the largest value of all pixels that the tolerance
 * does not ignore. Ignored pixels of `b` are read from `a`, so that they do not change the values of their neighbours.
 * Equal images have the mean 0. The order of the two images does not matter, unless pixels are ignored. The tolerance's
 * pixels_per_degree must be within the limits above.
 *
 * Each pixel's value, rounded to 0..255, is stored in `map`, which has a byte for each pixel or is null; ignored pixels
 * have the value 0. Returns false if memory runs out.
 *
 * The result is the same to the bit on every machine. The mean is within 3e-6 of the formulae in real numbers or, if
 * the images are flat, within 5e-5. Cost: about 60 ms for a megapixel at the default resolution. */
bool image_measure_flip(const image *a, const image *b, const image_tolerance *tolerance, uint8_t *map,
                        image_flip *flip);

/* The colours of a map: black for 0, pale yellow for the largest value. */
image_palette image_make_magma_palette(void);

#endif
