/* exact.h - sums that are not rounded.
 *
 * exact_sum holds any sum of up to 2^20 products of two doubles, as a fixed-point number wide enough for the smallest
 * and the largest of them (4300 bits): the "long accumulator" of U. Kulisch, Computer Arithmetic and Validity (2013).
 */
#ifndef OCTREE_EXACT_H
#define OCTREE_EXACT_H

#include "float_rules.h"

#include <stdint.h>

#define EXACT_DIGITS 140

/* Digits of 32 bits in 64-bit signed cells, so that carries can wait until the sign is asked for. Those from `first` to
 * `after` - 1 are in use, a few where the terms are of like size; the others are 0 and not written. */
typedef struct exact_sum {
    int first, after;
    int64_t digits[EXACT_DIGITS];
} exact_sum;

void exact_clear(exact_sum *sum);

/* Add factor * a * b, for a factor of -2, -1, 1 or 2 and finite a, b. */
void exact_add_product(exact_sum *sum, int factor, double a, double b);

/* -1, 0 or 1. The sum is used up. */
int exact_sign(exact_sum *sum);

/* The largest double at most a + b, and the smallest at least: of the real sum, not the rounded one. Beyond the range
 * of doubles these are +-DBL_MAX, or an infinity where no finite double is a bound. */
double exact_add_down(double a, double b);
double exact_add_up(double a, double b);

/* The neighbouring double towards minus infinity, of a finite one. */
double exact_step_down(double value);

#endif
