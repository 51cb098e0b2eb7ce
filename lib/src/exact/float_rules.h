/* float_rules.h - the arithmetic that the library's answers rest on. Included by every source that computes. */
#ifndef OCTREE_FLOAT_RULES_H
#define OCTREE_FLOAT_RULES_H

#include <float.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "Octreel's answers are exact: it must not be compiled with -ffast-math or -ffinite-math-only"
#endif
#if FLT_EVAL_METHOD != 0
#error "Octreel needs doubles that are evaluated as doubles (FLT_EVAL_METHOD 0); on 32-bit x86 use -msse2 -mfpmath=sse"
#endif

#endif
