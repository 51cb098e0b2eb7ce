/* SPDX-License-Identifier: MIT */
/* float_rules.h - what floating-point arithmetic must be for the library's answers to hold. Included by every source
 * that computes.
 *
 * Compile time: no fast-math, and doubles that are evaluated as doubles. Run time: the thread's mode is the default
 * one. SSE2 (every x86-64 has it) works on two doubles at once; the tests build the portable path too, by
 * OCTREE_PORTABLE. Subnormal numbers are counted rather than multiplied, which processors do slowly.
 */
#ifndef OCTREE_FLOAT_RULES_H
#define OCTREE_FLOAT_RULES_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "Octreel's answers are exact: it must not be compiled with -ffast-math or -ffinite-math-only"
#endif
/* 0 evaluates all types as themselves, 1 floats as doubles (s390x under -std=c17; the library has no floats), and 16 to
 * 64 what is shorter than that many bits. 2 is long double. */
#if FLT_EVAL_METHOD < 0 || FLT_EVAL_METHOD == 2 || FLT_EVAL_METHOD > 64
#if defined(__i386__)
#error "Octreel needs doubles that are evaluated as doubles, which the x87 does not: compile with -msse2 -mfpmath=sse"
#else
#error "Octreel needs doubles that are evaluated as doubles: this compiler does not do so here (see FLT_EVAL_METHOD)"
#endif
#endif

#if defined(__SSE2__) && !defined(OCTREE_PORTABLE)
#define OCTREE_SSE2
#include <emmintrin.h>
#endif

/* Whether the thread rounds to nearest and keeps subnormals. Hosts change that: audio and physics code flushes
 * subnormals to zero, interval code rounds up and down. On x86-64 one read of the control register tells (about 1 ns);
 * elsewhere operations that the compiler must not fold do. */
#if defined(__SSE2__)
#include <xmmintrin.h>

static inline bool float_mode_is_default(void)
{
    return (_mm_getcsr() & 0xe040u) == 0; /* flush to zero, rounding control, denormals are zero */
}
#else
static inline bool float_mode_is_default(void)
{
    static const volatile double one = 1, half_ulp = 0x1p-53, more = 0x1.8p-53, least = 0x1p-1074, normal = 0x1p-1022;
    const bool nearest = one + half_ulp == one && -one - half_ulp == -one && one + more > one && -one - more < -one;
    return nearest && least + least > 0 && normal * 0.5 > 0;
}
#endif

/* Many processors leave products with subnormal numbers to microcode, some 150 cycles each (measured: a nearest
 * neighbour in a world at 1e-310 took 21 times as long as elsewhere). Such a number is a whole multiple of 2^-1074, and
 * that multiple is an ordinary double. Differences of numbers below SUBNORMAL_HALF are subnormal or 0. */
#define SUBNORMAL_HALF 0x1p-1023

static inline bool is_subnormal(double x)
{
    return fabs(x) < 0x1p-1022;
}

/* x * 2^1074, exactly; is_subnormal(x). The bits of such a number are that integer. */
static inline double subnormal_count(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const double count = (double)(int64_t)(bits & INT64_MAX);
    return bits >> 63 ? -count : count;
}

/* The product with 2^-1074, rounded to even as that product is; |count| < 2^51. */
static inline double subnormal_of(double count)
{
    const double sum = fabs(count) + 0x1p52; /* rounds to a whole number */
    uint64_t bits;
    double x;
    memcpy(&bits, &sum, sizeof bits);
    bits &= (UINT64_C(1) << 52) - 1;
    memcpy(&x, &bits, sizeof x);
    return count < 0 ? -x : x;
}

#endif
