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
