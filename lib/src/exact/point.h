/* SPDX-License-Identifier: MIT */
/* point.h - comparisons of positions and boxes. */
#ifndef OCTREE_POINT_H
#define OCTREE_POINT_H

#include "float_rules.h"
#include "octree/types.h"

static inline octree_point point_of_body(const octree_body *body)
{
    return (octree_point){.position = {body->position[0], body->position[1], body->position[2]}, .id = body->id};
}

/* Returns whether two positions are equal. A single branch decides for all coordinates: if points share some
 * coordinates, as on a lattice, three branches would be unpredictable. */
static inline bool is_same_position(const double a[3], const double b[3])
{
#ifdef OCTREE_SSE2
    const __m128d xy = _mm_cmpeq_pd(_mm_loadu_pd(a), _mm_loadu_pd(b));
    const __m128d yz = _mm_cmpeq_pd(_mm_loadu_pd(a + 1), _mm_loadu_pd(b + 1));
    return _mm_movemask_pd(_mm_and_pd(xy, yz)) == 3;
#else
    return (a[0] == b[0]) & (a[1] == b[1]) & (a[2] == b[2]);
#endif
}

#ifdef OCTREE_SSE2
/* Compare the first coordinates of four points with `x`. Each 32-bit element of the result is -1 if equal, else 0. */
static inline __m128i compare_four_x(const octree_point *points, __m128d x)
{
    const __m128d a = _mm_loadh_pd(_mm_load_sd(points[0].position), points[1].position);
    const __m128d b = _mm_loadh_pd(_mm_load_sd(points[2].position), points[3].position);
    const __m128 a_equal = _mm_castpd_ps(_mm_cmpeq_pd(a, x)), b_equal = _mm_castpd_ps(_mm_cmpeq_pd(b, x));
    return _mm_castps_si128(_mm_shuffle_ps(a_equal, b_equal, _MM_SHUFFLE(2, 0, 2, 0)));
}

static inline uint64_t mask_four_equal(const octree_point *points, __m128d x)
{
    return (uint64_t)_mm_movemask_ps(_mm_castsi128_ps(compare_four_x(points, x)));
}

static inline uint64_t mask_sixteen_equal(const octree_point *points, __m128d x)
{
    const __m128i low = _mm_packs_epi32(compare_four_x(points, x), compare_four_x(points + 4, x));
    const __m128i high = _mm_packs_epi32(compare_four_x(points + 8, x), compare_four_x(points + 12, x));
    return (uint64_t)_mm_movemask_epi8(_mm_packs_epi16(low, high));
}
#endif

/* Returns a bit mask of the points, 1 to 64, whose first coordinate equals `x`. Points are compared 16 or four at a
 * time; the last 16 or four may overlap the previous ones.
 */
static inline uint64_t mask_equal_x(const octree_point *points, unsigned count, double x)
{
    uint64_t equal = 0;
#ifdef OCTREE_SSE2
    const __m128d both = _mm_set1_pd(x);
    if (count >= 16) {
        const octree_point *last = points + (count - 16);
        for (unsigned i = 0; points < last; i += 16, points += 16)
            equal |= mask_sixteen_equal(points, both) << i;
        return equal | mask_sixteen_equal(last, both) << (count - 16);
    }
    if (count >= 4) {
        const octree_point *last = points + (count - 4);
        for (unsigned i = 0; points < last; i += 4, points += 4)
            equal |= mask_four_equal(points, both) << i;
        return equal | mask_four_equal(last, both) << (count - 4);
    }
#endif
    for (unsigned i = 0; i < count; i++)
        equal |= (uint64_t)(points[i].position[0] == x) << i;
    return equal;
}

/* Compare two positions by their coordinates, for sorting. Returns -1, 0 or 1. */
static inline int compare_positions(const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++)
        if (a[i] != b[i])
            return a[i] < b[i] ? -1 : 1;
    return 0;
}

static inline bool is_finite_position(const double p[3])
{
    return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
}

/* Returns whether a box can be the world of a tree. */
static inline bool is_world(const octree_box *box)
{
    bool good = true;
    for (int i = 0; i < 3; i++)
        good &= isfinite(box->min[i]) && isfinite(box->max[i]) && box->min[i] < box->max[i];
    return good;
}

static inline bool box_contains(const octree_box *box, const double p[3])
{
#ifdef OCTREE_SSE2
    const __m128d xy = _mm_loadu_pd(p), yz = _mm_loadu_pd(p + 1);
    const __m128d above_min =
        _mm_and_pd(_mm_cmple_pd(_mm_loadu_pd(box->min), xy), _mm_cmple_pd(_mm_loadu_pd(box->min + 1), yz));
    const __m128d below_max =
        _mm_and_pd(_mm_cmple_pd(xy, _mm_loadu_pd(box->max)), _mm_cmple_pd(yz, _mm_loadu_pd(box->max + 1)));
    return _mm_movemask_pd(_mm_and_pd(above_min, below_max)) == 3;
#else
    bool inside = true;
    for (int i = 0; i < 3; i++) /* computes a single result without branches, because branches would be unpredictable */
        inside &= (box->min[i] <= p[i]) & (p[i] <= box->max[i]);
    return inside;
#endif
}

/* Round to the nearest float. Finite values beyond FLT_MAX become FLT_MAX with their sign; infinities stay infinite.
 * `volatile` works around a bug of GCC 12, which at -O3 drops one of three adjacent roundings. */
static inline double round_to_float(double x)
{
    const volatile float rounded = (float)(x > FLT_MAX ? FLT_MAX : x < -FLT_MAX ? -FLT_MAX : x);
    return isinf(x) ? x : (double)rounded;
}

#endif
