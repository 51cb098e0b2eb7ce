/* SPDX-License-Identifier: MIT */
/* portable_math.c - exp and log by range reduction and series.
 *
 * exp: x = n ln 2 + r with |r| <= ln 2 / 2. ln 2 is split in two parts, of which the first has 32 bits, so that n times
 * it is exact. The series of exp(r) converges to 17 digits in 14 terms, and ldexp multiplies by 2^n.
 *
 * log: x = m 2^e with m from sqrt(1/2) to sqrt(2). ln m = 2 artanh t with t = (m - 1) / (m + 1), |t| < 0.172: the
 * series in t^2 converges to 17 digits in 11 terms. A table would be faster, but these functions only fill tables. */
#include "portable_math.h"

#include <math.h>

#define LN2_HIGH 0x1.62e42fefp-1 /* the first 33 bits of ln 2 */
#define LN2_LOW 0x1.473de6af278edp-34
#define SQRT_HALF 0.70710678118654752

double portable_exp(double x)
{
    enum { TERMS = 14 };
    const double n = floor(x / (LN2_HIGH + LN2_LOW) + 0.5);
    const double r = (x - n * LN2_HIGH) - n * LN2_LOW;
    double sum = 1;
    for (int i = TERMS; i > 0; i--)
        sum = 1 + r * sum / i;
    return ldexp(sum, (int)n);
}

static double portable_log(double x)
{
    enum { TERMS = 11 };
    int exponent;
    double m = frexp(x, &exponent), sum = 0;
    if (m < SQRT_HALF) {
        m *= 2;
        exponent--;
    }
    const double t = (m - 1) / (m + 1);
    for (int i = TERMS; i >= 0; i--)
        sum = 1.0 / (2 * i + 1) + t * t * sum;
    return exponent * LN2_HIGH + (exponent * LN2_LOW + 2 * t * sum);
}

double portable_pow(double x, double y)
{
    return portable_exp(y * portable_log(x));
}
