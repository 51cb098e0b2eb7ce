/* SPDX-License-Identifier: MIT */
/* metric.h - computes squared distances in doubles, with a proven error bound. The squares neither overflow nor
 * underflow in any world.
 *
 * Coordinates are multiplied by a power of two, so that the world's extent is moderate: from 2^-99 to 2^100. Nearly all
 * worlds have a moderate extent, so their coordinates are not multiplied. For points of the world the product of
 * coordinate and power is exact, or has an error below 2^-1074 if the product is subnormal. The computed square s of a
 * real scaled square S satisfies |s - S| <= 6u s + 2^-1000 with u = 2^-53: one rounding in each difference, one in each
 * product, two in the sum. The squared distance from a target far outside the world may be infinite; a comparison with
 * an infinite square decides nothing.
 */
#ifndef OCTREE_METRIC_H
#define OCTREE_METRIC_H

#include "float_rules.h"
#include "octree/types.h"

typedef struct metric {
    double target[3]; /* the target in world units, not scaled */
    double scaled[3]; /* the target multiplied by `scale` */
    double scale;
    double grain; /* in a world of subnormal coordinates: scale * 2^-1074; else 0 */
} metric;

/* Returns the power of two by which the coordinates of a world are multiplied. The power is 1 if the world's extent is
 * moderate. Otherwise the power brings the extent near 1; it is between 2^-1020 and 2^1000, so that it is a normal
 * double. */
double metric_scale(const octree_box *world);

/* Returns a coordinate of the world multiplied by the scale. */
static inline double metric_scaled(const metric *m, double x)
{
    return m->grain > 0 ? subnormal_count(x) * m->grain : x * m->scale;
}

/* Set the scale and the scaled target of a metric. metric_set() calls this function if the scale is not 1. */
void metric_set_scaled(metric *m, double scale, bool subnormal);

static inline void metric_set(metric *m, double scale, bool subnormal, const double target[3])
{
    m->scale = 1;
    m->grain = 0;
    for (int i = 0; i < 3; i++)
        m->target[i] = m->scaled[i] = target[i];
    if (scale != 1)
        metric_set_scaled(m, scale, subnormal);
}

static inline metric metric_make(double scale, bool subnormal, const double target[3])
{
    metric m;
    metric_set(&m, scale, subnormal, target);
    return m;
}

/* Returns the scaled squared distance of a point from the target, (dx^2 + dy^2) + dz^2. The terms are added in this
 * order on every machine. */
static inline double metric_square(const metric *m, const double p[3])
{
    const double x = metric_scaled(m, p[0]) - m->scaled[0];
    const double y = metric_scaled(m, p[1]) - m->scaled[1];
    const double z = metric_scaled(m, p[2]) - m->scaled[2];
    return (x * x + y * y) + z * z;
}

/* Store the scaled squared distances of 1 to 64 points in squares[]. Each square equals the result of metric_square()
 * in every bit. Returns the least of the squares. */
double metric_compute_squares(const metric *m, const octree_point *points, unsigned count, double squares[]);

#ifdef OCTREE_SSE2
/* Returns a bit mask of four squares: bit i is set if squares[i] is not above `reach`. */
static inline uint64_t metric_mask_four_within(const double squares[4], __m128d reach)
{
    const __m128d a = _mm_cmpngt_pd(_mm_loadu_pd(squares), reach), b = _mm_cmpngt_pd(_mm_loadu_pd(squares + 2), reach);
    return (uint64_t)_mm_movemask_ps(_mm_shuffle_ps(_mm_castpd_ps(a), _mm_castpd_ps(b), _MM_SHUFFLE(2, 0, 2, 0)));
}
#endif

/* Returns a bit mask of 1 to 64 squares: bit i is set if squares[i] is not above `reach`. No branch depends on a
 * square, because such branches would be unpredictable. */
static inline uint64_t metric_mask_within(const double squares[], unsigned count, double reach)
{
    uint64_t within = 0;
#ifdef OCTREE_SSE2
    if (count >= 4) {
        const __m128d bound = _mm_set1_pd(reach);
        for (unsigned i = 0; i < count - 4; i += 4)
            within |= metric_mask_four_within(&squares[i], bound) << i;
        return within | metric_mask_four_within(&squares[count - 4], bound) << (count - 4);
    }
#endif
    for (unsigned i = 0; i < count; i++)
        within |= (uint64_t) !(squares[i] > reach) << i;
    return within;
}

/* Returns the scaled distance from the target to an interval on axis i. Returns 0 if the target is inside the
 * interval. */
static inline double metric_interval_distance(const metric *m, int i, double min, double max)
{
    const double below = metric_scaled(m, min) - m->scaled[i];
    const double above = m->scaled[i] - metric_scaled(m, max);
    return below > 0 ? below : above > 0 ? above : 0;
}

/* A computed square below this limit has not overflowed. A computed square above the limit may be too small by any
 * amount, because of overflow. */
#define METRIC_FINITE 0x1p1020

/* Bounds with which the comparison of two computed squares a and b is certain in spite of rounding. If a >
 * metric_above(b), the real square of a is certainly greater than the real square of b. If a < metric_below(b), the
 * real square of a is certainly less than the real square of b.
 *
 * The factor 2^-47 is 64u: 12u for the errors of both squares, 3u for the roundings of the bound itself, and the rest
 * covers 16u, the error with which nearest.c orders sibling nodes by distance. 2^-998 covers the absolute errors of
 * both squares (2^-1000 each). No square is greater than metric_above() of an infinite b, and a square that is NaN is
 * greater than nothing. */
static inline double metric_above(double b)
{
    return b * (1 + 0x1p-47) + 0x1p-998;
}

static inline double metric_below(double b)
{
    return (b < METRIC_FINITE ? b : METRIC_FINITE) * (1 - 0x1p-47) - 0x1p-998;
}

/* Returns the sign of |a - target|^2 - |b - target|^2, computed in real numbers: -1, 0 or 1. Exact for all finite
 * doubles. */
int metric_compare(const double target[3], const double a[3], const double b[3]);

/* Returns the sign of |p - target| - radius, computed in real numbers: -1, 0 or 1. Exact for all finite doubles. The
 * radius must not be negative. */
int metric_compare_radius(const double target[3], const double p[3], double radius);

/* An integer of 128 bits, high * 2^64 + low. */
typedef struct metric_integer {
    int64_t high;
    uint64_t low;
} metric_integer;

/* A unit of length: a power of two so small that most coordinates are whole numbers of it. The squared distance of a
 * point in this unit is an integer, which is computed once and compared many times. */
typedef struct metric_unit {
    double length, inverse;
    double limit;      /* the greatest magnitude that is converted to units */
    int64_t target[3]; /* the target in units; valid only if `limit` is not negative */
} metric_unit;

/* Set the unit for squared distances from `target` of points about as far away as p. */
void metric_set_unit(metric_unit *unit, const double target[3], const double p[3]);

/* Returns the squared distance of p from the unit's target. Returns a negative integer if the coordinates are not whole
 * numbers of the unit. */
metric_integer metric_integer_square(const metric_unit *unit, const double p[3]);

/* Returns the sign of a - b. */
static inline int metric_compare_integers(const metric_integer *a, const metric_integer *b)
{
    return a->high != b->high ? (a->high > b->high) - (a->high < b->high) : (a->low > b->low) - (a->low < b->low);
}

static inline double metric_length(double x, double y, double z)
{
    return sqrt((x * x + y * y) + z * z);
}

/* Returns the Euclidean distance, without overflow or underflow of squares. metric_distance() calls this function if
 * the square of `largest`, the largest absolute difference of two coordinates, may overflow or underflow. */
double metric_distance_without_overflow(const double a[3], const double b[3], double largest);

/* Returns the Euclidean distance, within 4 ulp. The result is infinite only if the distance is beyond DBL_MAX. */
static inline double metric_distance(const double a[3], const double b[3])
{
    const double x = fabs(a[0] - b[0]), y = fabs(a[1] - b[1]), z = fabs(a[2] - b[2]);
    const double xy = x > y ? x : y, largest = xy > z ? xy : z;
    return 0x1p-480 < largest && largest < 0x1p480 ? metric_length(x, y, z)
                                                   : metric_distance_without_overflow(a, b, largest);
}

#endif
