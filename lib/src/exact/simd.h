/* simd.h - where two doubles are worked on at once: in comparing a point with a box, which takes a third off box
 * queries, and in the distances of a leaf's points, which take no branch then, where a search for one point takes five
 * that cannot be foreseen. Private.
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
