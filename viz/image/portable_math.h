/* SPDX-License-Identifier: MIT */
/* portable_math.h - exp and pow with the same result on every machine. The C libraries' functions differ in the last
 * bits, and a measure that a test pins must not.
 *
 * Only +, -, *, /, frexp and ldexp are used, which IEEE 754 and C define to the bit. Relative error: below 1e-14 for
 * results from 1e-6 to 1e6, below 1e-12 for all normal results. Cost: about 30 ns. */
#ifndef IMAGE_PORTABLE_MATH_H
#define IMAGE_PORTABLE_MATH_H

/* Returns e to the power of x. x must be in -700..700. */
double portable_exp(double x);
/* Returns x to the power of y. x must be a positive normal number, and the result a normal number. */
double portable_pow(double x, double y);

#endif
