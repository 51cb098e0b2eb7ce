/* SPDX-License-Identifier: MIT */
/* exact.h - exact sums of doubles and of products of doubles, without rounding or overflow.
 *
 * exact_sum holds any sum of up to 2^20 products of two doubles. It is a fixed-point number of 4300 bits, wide enough
 * for the smallest and the largest product: the "long accumulator" of U. Kulisch, Computer Arithmetic and Validity
 * (2013).
 */
#ifndef OCTREE_EXACT_H
#define OCTREE_EXACT_H

#include "float_rules.h"

#include <string.h>

#define EXACT_DIGITS 140

/* Digits of 32 bits, each stored in a signed 64-bit integer. exact_sign() propagates the carries. Only the digits
 * [first, end) are in use; all other digits count as 0 and are not initialized. */
typedef struct exact_sum {
    int first, end;
    int64_t digits[EXACT_DIGITS];
} exact_sum;

void exact_clear(exact_sum *sum);

/* Add factor * a * b exactly. The factor is -2, -1, 1 or 2; a and b are finite. */
void exact_add_product(exact_sum *sum, int factor, double a, double b);

/* Returns the sign of the sum: -1, 0 or 1. The call changes the digits, so the sum must be cleared before it is used
 * again. */
int exact_sign(exact_sum *sum);

/* Returns the nearest double to the sum; a subnormal result may be one unit of 2^-1074 off. A sum beyond the
 * range of doubles gives an infinity. The call changes the digits, so the sum must be cleared before it is used again.
 */
double exact_round(exact_sum *sum);

/* Returns the sign of the exact sum of `count` terms: -1, 0 or 1. */
int exact_sign_of_sum(const double terms[], int count);

/* Returns the exact rounding error of `sum`, which is a + b rounded to a double, by Dekker's FastTwoSum: a + b is sum +
 * error. Knuth's TwoSum would not need ordered operands, but one of its intermediate results can overflow. */
static inline double exact_error_of_sum(double a, double b, double sum)
{
    return fabs(a) >= fabs(b) ? b - (sum - a) : a - (sum - b);
}

/* exact_add_down() returns the largest double that is not above the real sum a + b. exact_add_up() returns the smallest
 * double that is not below it. If a + b overflows, exact_add_down() returns DBL_MAX or -infinity, and exact_add_up()
 * returns infinity or -DBL_MAX. */
double exact_add_down(double a, double b);
double exact_add_up(double a, double b);

/* Returns whether the compiled code computes sums and products as the source states them. Two options change sums and
 * products, but define no macro that float_rules.h could test: clang's -ffp-contract=fast, which ignores the pragma,
 * and -funsafe-math-optimizations. */
bool has_exact_double_arithmetic(void);

/* Returns the next double below a finite value. */
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
