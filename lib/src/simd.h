/* simd.h - where two doubles are worked on at once. Private.
 *
 * SSE2 is part of every x86-64: nothing is chosen at run time. The same operations in the same order give the same bits
 * as the portable path, which the tests build by defining OCTREE_PORTABLE.
 */
#ifndef OCTREE_SIMD_H
#define OCTREE_SIMD_H

#if defined(__SSE2__) && !defined(OCTREE_PORTABLE)
#define OCTREE_SSE2
#include <emmintrin.h>
#endif

#endif
