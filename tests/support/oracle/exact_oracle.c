/* SPDX-License-Identifier: MIT */
/* exact_oracle.c - see exact_oracle.h. */
#include "exact_oracle.h"

#include <float.h>
#include <gmp.h>
#include <math.h>
#include <stdlib.h>

#include "brute.h"
#include "fixture.h"

/* value * 2^1074, exactly. */
static void set_scaled(mpz_t number, double value)
{
    int exponent;
    double mantissa = frexp(value, &exponent); /* value = mantissa * 2^exponent, mantissa in [0.5, 1) */
    mpz_set_d(number, ldexp(mantissa, 53));    /* a whole number */
    int shift = exponent - 53 + 1074;
    if (shift >= 0)
        mpz_mul_2exp(number, number, (mp_bitcnt_t)shift);
    else
        mpz_tdiv_q_2exp(number, number, (mp_bitcnt_t)-shift); /* the bits of a subnormal that are zero */
}

static void set_squared_distance(mpz_t sum, const double a[3], const double b[3])
{
    mpz_t p, q;
    mpz_inits(p, q, NULL);
    mpz_set_ui(sum, 0);
    for (int axis = 0; axis < 3; axis++) {
        set_scaled(p, a[axis]);
        set_scaled(q, b[axis]);
        mpz_sub(p, p, q);
        mpz_addmul(sum, p, p);
    }
    mpz_clears(p, q, NULL);
}

int exact_compare(const double target[3], const double a[3], const double b[3])
{
    mpz_t to_a, to_b;
    mpz_inits(to_a, to_b, NULL);
    set_squared_distance(to_a, target, a);
    set_squared_distance(to_b, target, b);
    int order = mpz_cmp(to_a, to_b);
    mpz_clears(to_a, to_b, NULL);
    return (order > 0) - (order < 0);
}

const octree_point *exact_nearest(const octree_point *points, size_t count, const double target[3], octree_skip skip,
                                  uint64_t skip_id)
{
    const octree_point *best = NULL;
    for (size_t i = 0; i < count; i++) {
        const octree_point *point = &points[i];
        if (brute_is_skipped(point, target, skip, skip_id))
            continue;
        int order = best == NULL ? -1 : exact_compare(target, point->position, best->position);
        if (order < 0 || (order == 0 && point->id < best->id))
            best = point;
    }
    return best;
}

typedef struct ranked {
    mpz_t square;
    const octree_point *point;
} ranked;

static int by_rank(const void *left, const void *right)
{
    const ranked *a = left;
    const ranked *b = right;
    int order = mpz_cmp(a->square, b->square);
    if (order != 0)
        return order;
    if (a->point->id != b->point->id)
        return a->point->id < b->point->id ? -1 : 1;
    for (int axis = 0; axis < 3; axis++)
        if (a->point->position[axis] != b->point->position[axis])
            return a->point->position[axis] < b->point->position[axis] ? -1 : 1;
    return 0;
}

size_t exact_nearest_sorted(const octree_point *points, size_t count, const double target[3], octree_skip skip,
                            uint64_t skip_id, octree_point *sorted)
{
    ranked *all = malloc((count + 1) * sizeof *all);
    assert_non_null(all);
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        if (brute_is_skipped(&points[i], target, skip, skip_id))
            continue;
        mpz_init(all[kept].square);
        set_squared_distance(all[kept].square, target, points[i].position);
        all[kept++].point = &points[i];
    }
    qsort(all, kept, sizeof *all, by_rank);
    for (size_t i = 0; i < kept; i++) {
        sorted[i] = *all[i].point;
        mpz_clear(all[i].square);
    }
    free(all);
    return kept;
}

int exact_compare_radius(const double center[3], const double p[3], double radius, double epsilon)
{
    mpz_t squared, reach, more;
    mpz_inits(squared, reach, more, NULL);
    set_squared_distance(squared, center, p);
    set_scaled(reach, radius);
    set_scaled(more, epsilon);
    mpz_add(reach, reach, more);
    mpz_mul(reach, reach, reach);
    int order = mpz_cmp(squared, reach);
    mpz_clears(squared, reach, more, NULL);
    return (order > 0) - (order < 0);
}

int exact_compare_ratio(const double target[3], const double a[3], const double b[3], double ratio)
{
    mpz_t to_a, to_b, factor, one;
    mpz_inits(to_a, to_b, factor, one, NULL);
    set_squared_distance(to_a, target, a);
    set_squared_distance(to_b, target, b);
    set_scaled(factor, ratio);
    set_scaled(one, 1);
    mpz_add(factor, factor, one); /* (1 + ratio) * 2^1074 */
    mpz_mul(factor, factor, factor);
    mpz_mul(one, one, one);
    mpz_mul(to_a, to_a, one);
    mpz_mul(to_b, to_b, factor);
    int order = mpz_cmp(to_a, to_b);
    mpz_clears(to_a, to_b, factor, one, NULL);
    return (order > 0) - (order < 0);
}

int exact_compare_longer(const double target[3], const double a[3], const double b[3], double length)
{
    mpz_t left, to_b, squared;
    mpz_inits(left, to_b, squared, NULL);
    set_squared_distance(left, target, a);
    set_squared_distance(to_b, target, b);
    set_scaled(squared, length);
    mpz_mul(squared, squared, squared);
    mpz_sub(left, left, to_b);
    mpz_sub(left, left, squared); /* a^2 - b^2 - length^2, to be compared with 2 * b * length */
    int order = mpz_sgn(left);
    if (order >= 0) {
        mpz_mul(left, left, left);
        mpz_mul(squared, squared, to_b);
        mpz_mul_ui(squared, squared, 4);
        order = mpz_cmp(left, squared);
    }
    mpz_clears(left, to_b, squared, NULL);
    return (order > 0) - (order < 0);
}

/* The sign of distance^2 - squared, where an infinite distance stands for all reals from DBL_MAX + half an ulp. */
static int compare_square(double distance, const mpz_t squared)
{
    if (isinf(distance))
        return 1;
    mpz_t square;
    mpz_init(square);
    set_scaled(square, distance);
    mpz_mul(square, square, square);
    int order = mpz_cmp(square, squared);
    mpz_clear(square);
    return order;
}

bool exact_distance_is(double distance, unsigned steps, const double a[3], const double b[3])
{
    double low = distance, high = distance;
    for (unsigned i = 0; i < steps; i++) {
        low = fmax(nextafter(low, -INFINITY), 0);
        high = nextafter(high, INFINITY);
    }
    mpz_t squared;
    mpz_init(squared);
    set_squared_distance(squared, a, b);
    bool above = isinf(low) ? compare_square(DBL_MAX, squared) < 0 : compare_square(low, squared) <= 0;
    bool near = distance >= 0 && above && compare_square(high, squared) >= 0;
    mpz_clear(squared);
    return near;
}

bool exact_within(double center, double size, double p)
{
    mpz_t a, b, r;
    mpz_inits(a, b, r, NULL);
    set_scaled(a, center);
    set_scaled(b, p);
    set_scaled(r, size);
    mpz_sub(a, a, b);
    bool within = mpz_cmpabs(a, r) <= 0;
    mpz_clears(a, b, r, NULL);
    return within;
}

static void set_difference(mpq_t difference, double a, double b)
{
    mpq_t other;
    mpq_init(other);
    mpq_set_d(difference, a);
    mpq_set_d(other, b);
    mpq_sub(difference, difference, other);
    mpq_clear(other);
}

/* Narrow [first, last] to the moments t when -size <= u + (w - u) * t <= size. False when there are none, at rest. */
static bool narrow(mpq_t first, mpq_t last, const mpq_t u, const mpq_t w, const mpq_t size)
{
    mpq_t way, low, high;
    mpq_inits(way, low, high, NULL);
    mpq_sub(way, w, u);
    mpq_neg(low, size);
    mpq_sub(low, low, u); /* low <= way * t <= high */
    mpq_sub(high, size, u);
    bool covered = mpq_sgn(low) <= 0 && mpq_sgn(high) >= 0;
    if (mpq_sgn(way) != 0) {
        mpq_div(low, low, way);
        mpq_div(high, high, way);
        if (mpq_sgn(way) < 0)
            mpq_swap(low, high);
        if (mpq_cmp(low, first) > 0)
            mpq_set(first, low);
        if (mpq_cmp(high, last) < 0)
            mpq_set(last, high);
        covered = true;
    }
    mpq_clears(way, low, high, NULL);
    return covered;
}

/* The moments of [0, 1] when the box covers the point on the three axes have one in common. */
bool exact_touches(const double from[3], const double to[3], double size, const double p[3], const double q[3],
                   const double half[3])
{
    mpq_t first, last, u, w, reach, own;
    mpq_inits(first, last, u, w, reach, own, NULL);
    mpq_set_ui(last, 1, 1);
    bool covered = true;
    for (int axis = 0; axis < 3 && covered; axis++) {
        set_difference(u, p[axis], from[axis]);
        set_difference(w, q[axis], to[axis]);
        mpq_set_d(reach, size);
        mpq_set_d(own, half ? half[axis] : 0);
        mpq_add(reach, reach, own);
        covered = narrow(first, last, u, w, reach);
    }
    covered = covered && mpq_cmp(first, last) <= 0;
    mpq_clears(first, last, u, w, reach, own, NULL);
    return covered;
}

/* (low * (2^depth - k) + high * k) * 2^1074, which is the plane times 2^(1074 + depth). */
static void set_plane(mpz_t plane, double low, double high, uint32_t k, unsigned depth)
{
    mpz_t other;
    mpz_init(other);
    set_scaled(plane, low);
    mpz_mul_ui(plane, plane, (1UL << depth) - k);
    set_scaled(other, high);
    mpz_addmul_ui(plane, other, k);
    mpz_clear(other);
}

/* A whole number times 2^-1074, towards zero; every such number here is below 2^1024. */
static double get_scaled(const mpz_t number)
{
    long exponent;
    double mantissa = mpz_get_d_2exp(&exponent, number); /* truncates to 53 bits */
    return ldexp(mantissa, (int)(exponent - 1074));
}

bool exact_plane(double low, double high, uint32_t k, unsigned depth, double *plane)
{
    mpz_t real, back;
    mpz_inits(real, back, NULL);
    set_plane(real, low, high, k, depth);
    bool whole = mpz_divisible_2exp_p(real, depth) != 0;
    mpz_tdiv_q_2exp(real, real, depth);
    *plane = get_scaled(real);
    set_scaled(back, *plane);
    bool exact = whole && mpz_cmp(real, back) == 0;
    mpz_clears(real, back, NULL);
    return exact;
}

bool exact_plane_is_near(double low, double high, uint32_t k, unsigned depth, unsigned steps, double plane)
{
    double largest = fmax(fabs(low), fabs(high));
    mpz_t real, given, spacing;
    mpz_inits(real, given, spacing, NULL);
    set_plane(real, low, high, k, depth);
    set_scaled(given, plane);
    mpz_mul_2exp(given, given, depth);
    mpz_sub(given, given, real);
    set_scaled(spacing, largest - nextafter(largest, 0));
    mpz_mul_2exp(spacing, spacing, depth);
    mpz_mul_ui(spacing, spacing, steps);
    bool near = mpz_cmpabs(given, spacing) <= 0;
    mpz_clears(real, given, spacing, NULL);
    return near;
}
