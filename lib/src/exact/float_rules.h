/* SPDX-License-Identifier: MIT */
/* float_rules.h - checks at compile time the floating-point rules on which the library's answers depend. Every source
 * file that computes with positions includes this file.
 *
 * The library must be compiled without fast-math, and doubles must be evaluated in double precision. float_mode.h sets
 * the floating-point mode in which the library runs. On x86-64, the library uses SSE2 to process two doubles at once;
 * OCTREE_PORTABLE selects the portable code instead, and the tests build both. Subnormal numbers are converted to
 * integers, because many processors multiply subnormal numbers slowly.
 */
#ifndef OCTREE_FLOAT_RULES_H
#define OCTREE_FLOAT_RULES_H

/* Forbid the compiler to contract a product and a sum to a fused multiply-add, which rounds once instead of twice. gcc
 * ignores the pragma of the C standard, and contracts unless -std=c17 or the like is given. See also
 * has_exact_double_arithmetic() in exact.h. */
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("fp-contract=off")
#else
#pragma STDC FP_CONTRACT OFF
#endif

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error                                                                                                                 \
    "Octreel must not be compiled with -ffast-math or -ffinite-math-only, because its answers are exact; in CMake, give such options to your own targets, with target_compile_options"
#endif
/* Accepted values of FLT_EVAL_METHOD. 0: each type is evaluated in its own precision. 1: floats are evaluated as
 * doubles (s390x under -std=c17), which does no harm, because the library computes in double. 16 to 64: only types of
 * fewer bits than this number are widened. The value 2, long double, is not supported. */
#if FLT_EVAL_METHOD < 0 || FLT_EVAL_METHOD == 2 || FLT_EVAL_METHOD > 64
#if defined(__i386__)
#error "Octreel needs arithmetic in double precision, which the x87 unit does not have: use -msse2 -mfpmath=sse"
#else
#error "Octreel needs arithmetic in double precision, which this compiler does not use (see FLT_EVAL_METHOD)"
#endif
#endif

#if defined(__SSE2__) && !defined(OCTREE_PORTABLE)
#define OCTREE_SSE2
#include <emmintrin.h>
#endif

/* Where the compiler can compile single files for AVX2, and ask the processor for it. On Windows, GCC does not align
 * the stack for AVX (its bug 54412). */
#if defined(OCTREE_SSE2) && defined(__x86_64__) && defined(__GNUC__) && !defined(_WIN32)
#define OCTREE_AVX2
#endif

/* Returns the sign bit of a number. The function has no branch. */
static inline unsigned is_negative(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (unsigned)(bits >> 63);
}

/* Subnormal numbers are converted to normal numbers, because many processors multiply subnormal numbers in microcode,
 * at some 150 cycles each. (In a measurement, a nearest-neighbour search in a world at 1e-310 took 21 times as long as
 * in other worlds.) A subnormal number is an integer multiple of 2^-1074, and this integer is a normal double. The
 * difference of two numbers below SUBNORMAL_HALF is subnormal or 0. */
#define SUBNORMAL_HALF 0x1p-1023

static inline bool is_subnormal(double x)
{
    return fabs(x) < 0x1p-1022;
}

/* Returns x * 2^1074, exactly, for a subnormal x. The result is an integer, whose value is the bits of x without the
 * sign bit. */
static inline double subnormal_count(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const double count = (double)(int64_t)(bits & INT64_MAX);
    return bits >> 63 ? -count : count;
}

/* Returns count * 2^-1074, rounded to nearest even, like the product of two doubles. |count| must be below 2^51. */
static inline double subnormal_from_count(double count)
{
    const double sum = fabs(count) + 0x1p52; /* adding 2^52 rounds to an integer */
    uint64_t bits;
    double x;
    memcpy(&bits, &sum, sizeof bits);
    bits &= (UINT64_C(1) << 52) - 1;
    memcpy(&x, &bits, sizeof x);
    return count < 0 ? -x : x;
}

#endif
