/* float_mode.h - is the thread's floating-point mode the one that answers are proven for? Private.
 *
 * Hosts change it: audio and physics code flushes subnormals to zero, interval code rounds up and down. On x86-64 one
 * read of the control register tells (about 1 ns); elsewhere two operations that the compiler must not fold do.
 */
#ifndef OCTREE_FLOAT_MODE_H
#define OCTREE_FLOAT_MODE_H

#include <stdbool.h>

#if defined(__SSE2__)
#include <xmmintrin.h>

#define FLOAT_MODE_UNUSUAL 0xe040u /* flush to zero, rounding control, denormals are zero */

static inline bool float_mode_is_default(void)
{
    return (_mm_getcsr() & FLOAT_MODE_UNUSUAL) == 0;
}

#else

static inline bool float_mode_is_default(void)
{
    static const volatile double one = 1, half_ulp = 0x1p-53, more = 0x1.8p-53, least = 0x1p-1074, normal = 0x1p-1022;
    const bool nearest = one + half_ulp == one && -one - half_ulp == -one && one + more > one && -one - more < -one;
    return nearest && least + least > 0 && normal * 0.5 > 0;
}

#endif

#endif
