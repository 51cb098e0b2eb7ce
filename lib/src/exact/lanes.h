/* SPDX-License-Identifier: MIT */
/* lanes.h - arithmetic on two doubles at once, in SSE2 or in portable C, or on four in AVX2. Private.
 *
 * Loops that compare a query with many boxes or bodies are written once, in these operations. Each lane has the same
 * results in all three. Comparisons follow SSE2: lanes_larger() and lanes_smaller() return the second operand if one of
 * both is NaN. A source file that is compiled for AVX2 defines OCTREE_FOUR_LANES; it runs only on processors that have
 * AVX2 (bodies/bounds_avx2.c).
 */
#ifndef OCTREE_LANES_H
#define OCTREE_LANES_H

#include "float_rules.h"
#include "octree/types.h"

#include <math.h>
#include <stdbool.h>

#ifdef OCTREE_FOUR_LANES
#include "four_lanes.h"
#else
enum { LANES = 2 };

#ifdef OCTREE_SSE2
typedef __m128d lanes;
typedef __m128i lane_bits; /* two unsigned integers of 64 bits */

static inline lanes lanes_of(double a, double b)
{
    return _mm_set_pd(b, a);
}

static inline lanes lanes_add(lanes a, lanes b)
{
    return _mm_add_pd(a, b);
}

static inline lanes lanes_subtract(lanes a, lanes b)
{
    return _mm_sub_pd(a, b);
}

static inline lanes lanes_multiply(lanes a, lanes b)
{
    return _mm_mul_pd(a, b);
}

static inline lanes lanes_absolute(lanes a)
{
    return _mm_andnot_pd(_mm_set1_pd(-0.0), a);
}

static inline lanes lanes_larger(lanes a, lanes b)
{
    return _mm_max_pd(a, b);
}

static inline lanes lanes_smaller(lanes a, lanes b)
{
    return _mm_min_pd(a, b);
}

/* Returns a mask of two bits: whether a < b. */
static inline unsigned lanes_less(lanes a, lanes b)
{
    return (unsigned)_mm_movemask_pd(_mm_cmplt_pd(a, b));
}

static inline void lanes_store(double *to, lanes a)
{
    _mm_storeu_pd(to, a);
}

static inline lanes lanes_load(const double from[2])
{
    return _mm_loadu_pd(from);
}

/* Returns the numbers bits & mask as doubles. The mask is below 2^52: the bits become the mantissa of a double from
 * 2^52 to 2^53. */
static inline lanes lanes_of_bits(lane_bits bits, uint64_t mask)
{
    const lanes from = _mm_set1_pd(0x1p52);
    const __m128i kept = _mm_and_si128(bits, _mm_set1_epi64x((long long)mask));
    return _mm_sub_pd(_mm_or_pd(_mm_castsi128_pd(kept), from), from);
}

static inline lane_bits lanes_load_ids(const octree_point *const points[LANES])
{
    return _mm_unpacklo_epi64(_mm_loadl_epi64((const __m128i *)&points[0]->id),
                              _mm_loadl_epi64((const __m128i *)&points[1]->id));
}

static inline void lanes_load_positions(lanes to[3], const double a[3], const double b[3])
{
    const lanes xy_a = _mm_loadu_pd(a), xy_b = _mm_loadu_pd(b);
    to[0] = _mm_unpacklo_pd(xy_a, xy_b);
    to[1] = _mm_unpackhi_pd(xy_a, xy_b);
    to[2] = _mm_loadh_pd(_mm_load_sd(&a[2]), &b[2]);
}
#else
typedef struct lanes {
    double at[2];
} lanes;

typedef struct lane_bits {
    uint64_t at[2];
} lane_bits;

static inline lanes lanes_of(double a, double b)
{
    return (lanes){{a, b}};
}

static inline lanes lanes_add(lanes a, lanes b)
{
    return (lanes){{a.at[0] + b.at[0], a.at[1] + b.at[1]}};
}

static inline lanes lanes_subtract(lanes a, lanes b)
{
    return (lanes){{a.at[0] - b.at[0], a.at[1] - b.at[1]}};
}

static inline lanes lanes_multiply(lanes a, lanes b)
{
    return (lanes){{a.at[0] * b.at[0], a.at[1] * b.at[1]}};
}

static inline lanes lanes_absolute(lanes a)
{
    return (lanes){{fabs(a.at[0]), fabs(a.at[1])}};
}

static inline lanes lanes_larger(lanes a, lanes b)
{
    return (lanes){{a.at[0] > b.at[0] ? a.at[0] : b.at[0], a.at[1] > b.at[1] ? a.at[1] : b.at[1]}};
}

static inline lanes lanes_smaller(lanes a, lanes b)
{
    return (lanes){{a.at[0] < b.at[0] ? a.at[0] : b.at[0], a.at[1] < b.at[1] ? a.at[1] : b.at[1]}};
}

static inline unsigned lanes_less(lanes a, lanes b)
{
    return (unsigned)(a.at[0] < b.at[0]) | (unsigned)(a.at[1] < b.at[1]) << 1;
}

static inline lane_bits lanes_load_ids(const octree_point *const points[LANES])
{
    return (lane_bits){{points[0]->id, points[1]->id}};
}

static inline lanes lanes_of_bits(lane_bits bits, uint64_t mask)
{
    return (lanes){{(double)(bits.at[0] & mask), (double)(bits.at[1] & mask)}};
}

static inline void lanes_store(double *to, lanes a)
{
    to[0] = a.at[0];
    to[1] = a.at[1];
}

static inline lanes lanes_load(const double from[2])
{
    return (lanes){{from[0], from[1]}};
}

static inline void lanes_load_positions(lanes to[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = (lanes){{a[i], b[i]}};
}
#endif

static inline lanes lanes_all(double a)
{
    return lanes_of(a, a);
}

static inline void lanes_load_points(lanes position[3], lane_bits *ids, const octree_point *const points[LANES])
{
    lanes_load_positions(position, points[0]->position, points[1]->position);
    *ids = lanes_load_ids(points);
}

static inline void lanes_load_boxes(lanes min[3], lanes max[3], const octree_box *const boxes[LANES])
{
    lanes_load_positions(min, boxes[0]->min, boxes[1]->min);
    lanes_load_positions(max, boxes[0]->max, boxes[1]->max);
}

/* Return the least and the greatest number of the lanes, which are not NaN. */
static inline double lanes_least(lanes a)
{
    double both[2];
    lanes_store(both, a);
    return both[0] < both[1] ? both[0] : both[1];
}

static inline double lanes_greatest(lanes a)
{
    double both[2];
    lanes_store(both, a);
    return both[0] > both[1] ? both[0] : both[1];
}
#endif

/* Returns the index of the first item of a group of LANES items of an array, in a loop over all groups: i = 0, LANES,
 * 2 * LANES ... The last group overlaps the one before it unless it is full. If the array is shorter than a group, its
 * last item fills the group: see lane_index(). */
static inline unsigned begin_of_group(unsigned count, unsigned i)
{
    return i + LANES > count && i > 0 ? count - LANES : i;
}

/* Returns the index of the item of a lane in a group. */
static inline unsigned lane_index(unsigned count, unsigned begin, unsigned lane)
{
    return begin + (lane < count ? lane : count - 1);
}

#endif
