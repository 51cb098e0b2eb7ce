/* subnormal.h - products with numbers below 2^-1022, as fast as others. Private.
 *
 * Many processors leave them to microcode, which takes some 150 cycles a product (measured here: a nearest neighbour in
 * a world at 1e-310 took 21 times as long as elsewhere). Such a number is a whole multiple of 2^-1074; that multiple is
 * an ordinary double.
 */
#ifndef OCTREE_SUBNORMAL_H
#define OCTREE_SUBNORMAL_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* Differences of two numbers below it are subnormal or 0. */
#define SUBNORMAL_HALF 0x1p-1023

static inline bool is_subnormal(double x)
{
    return fabs(x) < 0x1p-1022;
}

/* x * 2^1074, exactly; is_subnormal(x). Its bits, put behind those of 2^52, are 2^52 more. */
static inline double subnormal_count(double x)
{
    const uint64_t sign = UINT64_C(1) << 63, exponent = UINT64_C(0x433) << 52;
    uint64_t bits, more, base;
    double sum, part;
    memcpy(&bits, &x, sizeof bits);
    more = bits | exponent;
    base = (bits & sign) | exponent;
    memcpy(&sum, &more, sizeof sum);
    memcpy(&part, &base, sizeof part);
    return sum - part;
}

/* The product with 2^-1074, rounded to even as that product is; |count| < 2^51. */
static inline double subnormal_of(double count)
{
    const double base = count < 0 ? -0x1p52 : 0x1p52;
    const double sum = base + count; /* rounds to a whole number */
    uint64_t bits;
    double x;
    memcpy(&bits, &sum, sizeof bits);
    bits &= (UINT64_C(1) << 63) | ((UINT64_C(1) << 52) - 1);
    memcpy(&x, &bits, sizeof x);
    return x;
}

#endif
