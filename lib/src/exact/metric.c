/* SPDX-License-Identifier: MIT */
/* metric.c - squared distances in scaled doubles, and their exact comparison.
 *
 * Problem: a search compares thousands of distances. Squares of coordinates near 1e200 overflow, and squares of
 * coordinates near 1e-200 underflow. Rounding can make the farther of two points at nearly the same distance look
 * nearer.
 *
 * Idea: multiply coordinates by a power of two, so that the world's extent is near 1; this loses nothing. Compute
 * squares in doubles with a proven error bound (metric.h). Only when two squares are closer than the bound, compare the
 * real distances with exact sums (exact.h). So nearly every comparison only compares doubles, and no comparison is
 * wrong.
 *
 * Why not exact arithmetic throughout: it is far too slow. Why not an epsilon: it has no right value,
 * and ties would depend on the order of insertion. Cost: metric_scan_points() compares two points at a time with SSE2;
 * the exact comparison adds up to twelve products. Worlds of subnormal coordinates use integers (float_rules.h).
 */
#include "metric.h"
#include "exact.h"
#include "point.h"

double metric_scale(const octree_box *world)
{
    double extent = 0;
    for (int i = 0; i < 3; i++) {
        const double side = world->max[i] / 2 - world->min[i] / 2;
        extent = side > extent ? side : extent;
    }
    int exponent;
    frexp(extent, &exponent);
    exponent = exponent < -999 ? -999 : exponent > 1019 ? 1019 : exponent;
    return ldexp(1.0, -exponent - 1);
}

metric metric_make(double scale, bool subnormal, const double target[3])
{
    metric m = {.scale = scale, .grain = subnormal ? scale * 0x1p-1000 * 0x1p-74 : 0};
    for (int i = 0; i < 3; i++) {
        m.target[i] = target[i];
        m.scaled[i] = subnormal && is_subnormal(target[i]) ? metric_scaled(&m, target[i]) : target[i] * scale;
    }
    return m;
}

#ifdef OCTREE_SSE2
/* Compute the squared distances of two points from the target at once. Not valid for worlds of subnormal
 * coordinates. */
static inline __m128d compute_pair_squares(const double a[3], const double b[3], const __m128d target[3], __m128d scale)
{
    const __m128d xy_a = _mm_loadu_pd(a), xy_b = _mm_loadu_pd(b), z = _mm_loadh_pd(_mm_load_sd(&a[2]), &b[2]);
    const __m128d x = _mm_sub_pd(_mm_mul_pd(_mm_unpacklo_pd(xy_a, xy_b), scale), target[0]);
    const __m128d y = _mm_sub_pd(_mm_mul_pd(_mm_unpackhi_pd(xy_a, xy_b), scale), target[1]);
    const __m128d up = _mm_sub_pd(_mm_mul_pd(z, scale), target[2]);
    return _mm_add_pd(_mm_add_pd(_mm_mul_pd(x, x), _mm_mul_pd(y, y)), _mm_mul_pd(up, up));
}

typedef struct pair_scan {
    __m128d target[3], scale, reach, least;
    uint64_t within;
} pair_scan;

static inline void scan_pair(pair_scan *s, const octree_point *points, unsigned i, double squares[])
{
    const __m128d pair = compute_pair_squares(points[i].position, points[i + 1].position, s->target, s->scale);
    s->within |= (uint64_t)_mm_movemask_pd(_mm_cmpngt_pd(pair, s->reach)) << i;
    s->least = _mm_min_pd(pair, s->least);
    _mm_storeu_pd(&squares[i], pair);
}

/* Scan points in pairs. If the count is odd, the last pair overlaps the previous pair, so that no branch depends on
 * whether the count is odd. */
static metric_scan scan_pairs(const metric *m, const octree_point *points, unsigned count, double reach,
                              double squares[])
{
    pair_scan s = {.scale = _mm_set1_pd(m->scale), .reach = _mm_set1_pd(reach), .least = _mm_set1_pd(INFINITY)};
    for (int i = 0; i < 3; i++)
        s.target[i] = _mm_set1_pd(m->scaled[i]);
    for (unsigned i = 0; i < count - 2; i += 2)
        scan_pair(&s, points, i, squares);
    scan_pair(&s, points, count - 2, squares);
    return (metric_scan){s.within, _mm_cvtsd_f64(_mm_min_sd(_mm_unpackhi_pd(s.least, s.least), s.least))};
}
#endif

metric_scan metric_scan_points(const metric *m, const octree_point *points, unsigned count, double reach,
                               double squares[])
{
#ifdef OCTREE_SSE2
    if (count > 1 && !(m->grain > 0))
        return scan_pairs(m, points, count, reach, squares);
#endif
    metric_scan scan = {0, INFINITY};
    for (unsigned i = 0; i < count; i++) {
        squares[i] = metric_square(m, points[i].position);
        scan.within |= (uint64_t) !(squares[i] > reach) << i;
        scan.least = squares[i] < scan.least ? squares[i] : scan.least;
    }
    return scan;
}

int metric_compare(const double target[3], const double a[3], const double b[3])
{
    /* |a - t|^2 - |b - t|^2 is the sum of a^2 - 2at - b^2 + 2bt over the axes: twelve exact products, or fewer if
     * coordinates are equal. */
    /* Many points may share one position, so equal positions are compared often. */
    if (same_position(a, b))
        return 0;
    exact_sum sum;
    exact_clear(&sum);
    for (int i = 0; i < 3; i++) {
        if (a[i] == b[i])
            continue;
        exact_add_product(&sum, 1, a[i], a[i]);
        exact_add_product(&sum, -2, a[i], target[i]);
        exact_add_product(&sum, -1, b[i], b[i]);
        exact_add_product(&sum, 2, b[i], target[i]);
    }
    return exact_sign(&sum);
}

int metric_compare_radius(const double target[3], const double p[3], double radius)
{
    /* An exact comparison takes 2 us, and most points are far from the sphere. The error of the distance is less than
     * half of the margin, unless a distance just below DBL_MAX becomes infinite. */
    const double distance = metric_distance(target, p);
    if (radius > 0x1p-1000 && (distance <= DBL_MAX || radius < DBL_MAX / 2) &&
        fabs(distance - radius) > radius * 0x1p-48)
        return distance < radius ? -1 : 1;
    exact_sum sum;
    exact_clear(&sum);
    for (int i = 0; i < 3; i++) {
        exact_add_product(&sum, 1, p[i], p[i]);
        exact_add_product(&sum, -2, p[i], target[i]);
        exact_add_product(&sum, 1, target[i], target[i]);
    }
    exact_add_product(&sum, -1, radius, radius);
    return exact_sign(&sum);
}

static double vector_length(const double gap[3])
{
    return sqrt((gap[0] * gap[0] + gap[1] * gap[1]) + gap[2] * gap[2]);
}

static double subnormal_length(const double gap[3])
{
    const double counts[3] = {subnormal_count(gap[0]), subnormal_count(gap[1]), subnormal_count(gap[2])};
    const double length = vector_length(counts);
    return length < 0x1p51 ? subnormal_from_count(length) : ldexp(length, -1074);
}

double metric_distance(const double a[3], const double b[3])
{
    double gap[3], largest = 0;
    for (int i = 0; i < 3; i++) {
        gap[i] = fabs(a[i] - b[i]);
        largest = gap[i] > largest ? gap[i] : largest;
    }
    if (0x1p-480 < largest && largest < 0x1p480)
        return vector_length(gap);
    if (is_subnormal(largest))
        return subnormal_length(gap);
    const bool halve = isinf(largest);
    int exponent = 1024;
    if (!halve)
        frexp(largest, &exponent);
    for (int i = 0; i < 3; i++)
        gap[i] = halve ? ldexp(fabs(a[i] / 2 - b[i] / 2), 1 - exponent) : ldexp(gap[i], -exponent);
    return ldexp(vector_length(gap), exponent);
}
