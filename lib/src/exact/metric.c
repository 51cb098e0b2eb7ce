/* SPDX-License-Identifier: MIT */
/* metric.c - squared distances in scaled doubles, and their exact comparison.
 *
 * Problem: a search compares thousands of distances. Squares of coordinates near 1e200 overflow, and squares of
 * coordinates near 1e-200 underflow. Rounding can make the farther of two points at nearly the same distance look
 * nearer.
 *
 * Idea: multiply coordinates by a power of two, so that the world's extent is moderate; such a product is exact unless
 * it is subnormal. Compute squares in doubles with a proven error bound (metric.h). Only when two squares are closer
 * than the bound, compare the real distances with exact sums (exact.h). So nearly every comparison only compares
 * doubles, and no comparison is wrong.
 *
 * Why not exact arithmetic throughout: it is far too slow. Why not an epsilon: it has no right value,
 * and ties would depend on the order of insertion. Cost: metric_compute_squares() takes about nine instructions a point
 * with SSE2; the exact comparison adds three products of integers, or up to twelve of doubles. Worlds of subnormal
 * coordinates use integers (float_rules.h).
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
    if (-100 < exponent && exponent < 100)
        return 1;
    exponent = exponent < -999 ? -999 : exponent > 1019 ? 1019 : exponent;
    return ldexp(1.0, -exponent - 1);
}

void metric_set_scaled(metric *m, double scale, bool subnormal)
{
    m->scale = scale;
    m->grain = subnormal ? scale * 0x1p-1000 * 0x1p-74 : 0;
    for (int i = 0; i < 3; i++)
        m->scaled[i] = subnormal && is_subnormal(m->target[i]) ? metric_scaled(m, m->target[i]) : m->target[i] * scale;
}

#ifdef OCTREE_SSE2
/* Compute the squared distances of two points from the target at once. Only valid if the scale is 1. */
static inline __m128d compute_pair_squares(const double a[3], const double b[3], const __m128d target[3])
{
    const __m128d xy_a = _mm_loadu_pd(a), xy_b = _mm_loadu_pd(b), z = _mm_loadh_pd(_mm_load_sd(&a[2]), &b[2]);
    const __m128d x = _mm_sub_pd(_mm_unpacklo_pd(xy_a, xy_b), target[0]);
    const __m128d y = _mm_sub_pd(_mm_unpackhi_pd(xy_a, xy_b), target[1]);
    const __m128d up = _mm_sub_pd(z, target[2]);
    return _mm_add_pd(_mm_add_pd(_mm_mul_pd(x, x), _mm_mul_pd(y, y)), _mm_mul_pd(up, up));
}

/* Compute the squared distances of four points. `least` holds two minima of the previous squares: one of the points
 * with even index, one of the points with odd index. Returns the new minima. */
static inline __m128d compute_four_squares(const octree_point *points, const __m128d target[3], double squares[4],
                                           __m128d least)
{
    const __m128d a = compute_pair_squares(points[0].position, points[1].position, target);
    const __m128d b = compute_pair_squares(points[2].position, points[3].position, target);
    _mm_storeu_pd(squares, a);
    _mm_storeu_pd(squares + 2, b);
    return _mm_min_pd(_mm_min_pd(least, a), b);
}

/* Compute the squares of four points at a time. The last four points may overlap the previous four, so that no branch
 * depends on the remainder of the count. */
static double compute_squares_in_fours(const metric *m, const octree_point *points, unsigned count, double squares[])
{
    const __m128d target[3] = {_mm_set1_pd(m->scaled[0]), _mm_set1_pd(m->scaled[1]), _mm_set1_pd(m->scaled[2])};
    __m128d least = _mm_set1_pd(INFINITY);
    for (unsigned i = 0; i < count - 4; i += 4)
        least = compute_four_squares(&points[i], target, &squares[i], least);
    least = compute_four_squares(&points[count - 4], target, &squares[count - 4], least);
    return _mm_cvtsd_f64(_mm_min_sd(_mm_unpackhi_pd(least, least), least));
}
#endif

double metric_compute_squares(const metric *m, const octree_point *points, unsigned count, double squares[])
{
#ifdef OCTREE_SSE2
    if (count >= 4 && m->scale == 1)
        return compute_squares_in_fours(m, points, count, squares);
#endif
    double least = INFINITY;
    for (unsigned i = 0; i < count; i++) {
        squares[i] = metric_square(m, points[i].position);
        least = squares[i] < least ? squares[i] : least;
    }
    return least;
}

/* ---- Exact comparison ---------------------------------------------------------------------------------------- */

/* Points on a grid have many neighbours at the same distance, so ties must not be slow. Coordinates that are compared
 * usually have similar exponents: each is n * 2^e with one common e and |n| <= 2^61. Products of such integers are
 * added in 128 bits, in a tenth of the time of an exact_sum. */

/* Choose a unit so that `largest` is between 2^59 and 2^60 units. Returns false if `largest` is below 2^-900 or above
 * 2^900. */
static bool choose_unit(metric_unit *unit, double largest)
{
    if (!(largest > 0x1p-900 && largest < 0x1p900))
        return false;
    uint64_t exponent;
    memcpy(&exponent, &largest, sizeof exponent);
    exponent >>= 52; /* 2^(exponent - 1023) is the largest power of two <= largest */
    const uint64_t inverse_bits = (2 * 1023 + 59 - exponent) << 52, length_bits = (exponent - 59) << 52;
    memcpy(&unit->inverse, &inverse_bits, sizeof unit->inverse);
    memcpy(&unit->length, &length_bits, sizeof unit->length);
    unit->limit = unit->length * 0x1p61;
    return true;
}

/* Store in units[] integers so that values[i] = units[i] * unit->length. Returns false if there are no such integers of
 * at most 2^61. */
static inline bool convert_to_units(const metric_unit *unit, const double values[], int count, int64_t units[])
{
    for (int i = 0; i < count; i++) {
        if (!(fabs(values[i]) <= unit->limit))
            return false;
        units[i] = (int64_t)(values[i] * unit->inverse);
        if ((double)units[i] * unit->length != values[i])
            return false;
    }
    return true;
}

static inline double find_largest_magnitude(const double values[], int count, double largest)
{
    for (int i = 0; i < count; i++)
        largest = fabs(values[i]) > largest ? fabs(values[i]) : largest;
    return largest;
}

static bool convert_to_common_integers(const double values[], int count, int64_t units[])
{
    metric_unit unit;
    return choose_unit(&unit, find_largest_magnitude(values, count, 0)) &&
           convert_to_units(&unit, values, count, units);
}

/* Add a * b. The factors are at most 2^62, the sum stays below 2^127. */
static void add_wide_product(metric_integer *sum, int64_t a, int64_t b)
{
    const uint64_t x = (uint64_t)(a < 0 ? -a : a), y = (uint64_t)(b < 0 ? -b : b);
    const uint64_t x_low = x & UINT32_MAX, x_high = x >> 32, y_low = y & UINT32_MAX, y_high = y >> 32;
    const uint64_t least = x_low * y_low, middle = x_low * y_high + x_high * y_low + (least >> 32);
    uint64_t low = middle << 32 | (least & UINT32_MAX), high = x_high * y_high + (middle >> 32);
    if ((a < 0) != (b < 0)) { /* negate */
        low = -low;
        high = ~high + (low == 0);
    }
    sum->low += low;
    sum->high += (int64_t)(high + (sum->low < low));
}

static int sign_of_metric_integer(const metric_integer *sum)
{
    return sum->high < 0 ? -1 : (sum->high | (int64_t)(sum->low != 0)) != 0;
}

void metric_set_unit(metric_unit *unit, const double target[3], const double p[3])
{
    if (!choose_unit(unit, find_largest_magnitude(p, 3, find_largest_magnitude(target, 3, 0))) ||
        !convert_to_units(unit, target, 3, unit->target))
        unit->limit = -1;
}

metric_integer metric_integer_square(const metric_unit *unit, const double p[3])
{
    int64_t units[3];
    if (!convert_to_units(unit, p, 3, units))
        return (metric_integer){-1, 0};
    metric_integer sum = {0, 0};
    for (int i = 0; i < 3; i++)
        add_wide_product(&sum, units[i] - unit->target[i], units[i] - unit->target[i]);
    return sum;
}

/* With the target t, |a - t|^2 - |b - t|^2 is the sum of (a - b) (a + b - 2t) over the axes. */
static int compare_integer_distances(const int64_t target[3], const int64_t a[3], const int64_t b[3])
{
    metric_integer sum = {0, 0};
    for (int i = 0; i < 3; i++)
        add_wide_product(&sum, a[i] - b[i], a[i] + b[i] - 2 * target[i]);
    return sign_of_metric_integer(&sum);
}

int metric_compare(const double target[3], const double a[3], const double b[3])
{
    /* Many points may share one position, so equal positions are compared often. */
    if (is_same_position(a, b))
        return 0;
    const double values[9] = {target[0], target[1], target[2], a[0], a[1], a[2], b[0], b[1], b[2]};
    int64_t units[9];
    if (convert_to_common_integers(values, 9, units))
        return compare_integer_distances(units, units + 3, units + 6);
    /* |a - t|^2 - |b - t|^2 is also the sum of a^2 - 2at - b^2 + 2bt over the axes: twelve exact products, or fewer if
     * coordinates are equal. */
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

static int compare_integer_distance_with_radius(const int64_t target[3], const int64_t p[3], int64_t radius)
{
    metric_integer sum = {0, 0};
    for (int i = 0; i < 3; i++)
        add_wide_product(&sum, p[i] - target[i], p[i] - target[i]);
    add_wide_product(&sum, -radius, radius);
    return sign_of_metric_integer(&sum);
}

int metric_compare_radius(const double target[3], const double p[3], double radius)
{
    /* Most points are far from the sphere, so doubles decide first. The margin 2^-48 is
     * more than twice the relative error of the distance, unless a distance just below DBL_MAX becomes infinite. */
    const double distance = metric_distance(target, p);
    if (radius > 0x1p-1000 && (distance <= DBL_MAX || radius < DBL_MAX / 2) &&
        fabs(distance - radius) > radius * 0x1p-48)
        return distance < radius ? -1 : 1;
    const double values[7] = {p[0], p[1], p[2], target[0], target[1], target[2], radius};
    int64_t units[7];
    if (convert_to_common_integers(values, 7, units))
        return compare_integer_distance_with_radius(units, units + 3, units[6]);
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

static double subnormal_length(double x, double y, double z)
{
    const double length = metric_length(subnormal_count(x), subnormal_count(y), subnormal_count(z));
    return length < 0x1p51 ? subnormal_from_count(length) : ldexp(length, -1074);
}

double metric_distance_without_overflow(const double a[3], const double b[3], double largest)
{
    double gap[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    if (is_subnormal(largest))
        return subnormal_length(gap[0], gap[1], gap[2]);
    const bool halve = isinf(largest);
    int exponent = 1024;
    if (!halve)
        frexp(largest, &exponent);
    for (int i = 0; i < 3; i++)
        gap[i] = halve ? ldexp(a[i] / 2 - b[i] / 2, 1 - exponent) : ldexp(gap[i], -exponent);
    return ldexp(metric_length(gap[0], gap[1], gap[2]), exponent);
}
