/* SPDX-License-Identifier: MIT */
/* exact.h - sums that are not rounded.
 *
 * exact_sum holds any sum of up to 2^20 products of two doubles, as a fixed-point number wide enough for the smallest
 * and the largest of them (4300 bits): the "long accumulator" of U. Kulisch, Computer Arithmetic and Validity (2013).
 */
#ifndef OCTREE_EXACT_H
#define OCTREE_EXACT_H

#include "float_rules.h"

#include <string.h>

#define EXACT_DIGITS 140

/* Digits of 32 bits in 64-bit signed cells, so that carries can wait until the sign is asked for. Only [first, end) is
 * in use, a few digits where the terms are of similar size; the others count as 0 and are not initialized. */
typedef struct exact_sum {
    int first, end;
    int64_t digits[EXACT_DIGITS];
} exact_sum;

void exact_clear(exact_sum *sum);

/* Add factor * a * b, for a factor of -2, -1, 1 or 2 and finite a, b. */
void exact_add_product(exact_sum *sum, int factor, double a, double b);

/* -1, 0 or 1. Changes the sum: clear it before it is used again. */
int exact_sign(exact_sum *sum);

/* The largest double at most a + b, and the smallest at least: of the real sum, not the rounded one. Where the sum is
 * beyond the range of doubles, these are +-DBL_MAX, or an infinity where no finite double is a bound. */
double exact_add_down(double a, double b);
double exact_add_up(double a, double b);

/* The neighbouring double towards minus infinity, of a finite one. */
static inline double exact_step_down(double value)
{
    uint64_t bits;
    if (value == 0)
        return -0x1p-1074;
    memcpy(&bits, &value, sizeof bits);
    bits += value > 0 ? UINT64_MAX : 1;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
