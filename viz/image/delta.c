/* delta.c - see delta.h and IMAGE_DELTA_UNIT. */
#include "delta.h"

/* The measure's value for its two farthest colours of 8 bits a sample. */
#define LARGEST 35215.0

/* YIQ of the difference, for the conversion is linear: exact zeros for equal samples, and no cancellation. */
double delta_square(const pixel_samples *a, const pixel_samples *b, int range)
{
    const double r = a->of[0] - b->of[0], g = a->of[1] - b->of[1], u = a->of[2] - b->of[2];
    const double y = 0.29889531 * r + 0.58662247 * g + 0.11448223 * u;
    const double i = 0.59597799 * r - 0.27417610 * g - 0.32180189 * u;
    const double q = 0.21147017 * r - 0.52261711 * g + 0.31114694 * u;
    const double scale = range / 255.0;
    return (0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q) / (LARGEST * scale * scale);
}
