/* simd.h - where two doubles are worked on at once: in comparing a point with a box, which takes a third off box
 * queries. Distances gained nothing, from four points at once under AVX2 neither: there memory is what is waited for.
 * Private.
 *
 * SSE2 is part of every x86-64: nothing is chosen at run time. The tests build the portable path too, by
 * OCTREE_PORTABLE.
 */
#ifndef OCTREE_SIMD_H
#define OCTREE_SIMD_H

#if defined(__SSE2__) && !defined(OCTREE_PORTABLE)
#define OCTREE_SSE2
#include <emmintrin.h>
#endif

#endif
