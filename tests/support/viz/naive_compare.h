/* SPDX-License-Identifier: MIT */
/* naive_compare.h - the oracle of image comparison: pixel by pixel, straight from the definitions, in long double. */
#ifndef NAIVE_COMPARE_H
#define NAIVE_COMPARE_H

#include "image_compare.h"

/* A pixel's red, green and blue as numbers from 0 to 1. */
void naive_color(const image *image, int x, int y, double rgb[3]);

/* The distance of two colours in IMAGE_DELTA_UNIT; each is converted to YIQ separately. */
double naive_delta(const double a[3], const double b[3]);

/* Whether pixelmatch would call the pixel anti-aliased, in either image. */
bool naive_antialiased(const image *a, const image *b, int x, int y);

/* Compare two images. Must return the same counts and places as image_compare_within(). */
image_difference naive_compare(const image *a, const image *b, const image_tolerance *tolerance);

/* The test fails unless two differences are equal; worst_delta may differ by rounding. */
void assert_same_difference(const image_difference *a, const image_difference *b);

#endif
