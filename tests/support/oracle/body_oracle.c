/* SPDX-License-Identifier: MIT */
/* body_oracle.c - tests of bodies in rational numbers (GMP). */
#include "body_oracle.h"

#include <float.h>
#include <gmp.h>
#include <math.h>

#include "fixture.h"

/* An interval of rational numbers; an end that is not bounded is not read. */
typedef struct interval {
    mpq_t low, high;
    bool no_low, no_high;
} interval;

static void begin_interval(interval *i)
{
    mpq_init(i->low);
    mpq_init(i->high);
    i->no_low = i->no_high = false;
}

static void end_interval(interval *i)
{
    mpq_clear(i->low);
    mpq_clear(i->high);
}

/* sum += factor * a * b */
static void add_product(mpq_t sum, int factor, double a, double b)
{
    mpq_t x, y;
    mpq_init(x);
    mpq_init(y);
    mpq_set_d(x, a);
    mpq_set_d(y, factor * b);
    mpq_mul(x, x, y);
    mpq_add(sum, sum, x);
    mpq_clear(x);
    mpq_clear(y);
}

static void add(mpq_t sum, int factor, double a)
{
    add_product(sum, factor, a, 1);
}

/* Set an interval to the extent of a body on an axis. */
static void set_extent(interval *i, const octree_body *body, int axis)
{
    mpq_set_ui(i->low, 0, 1);
    mpq_set_ui(i->high, 0, 1);
    add(i->low, 1, body->position[axis]);
    add(i->high, 1, body->position[axis]);
    add(i->low, -1, body->half[axis]);
    add(i->high, 1, body->half[axis]);
}

static void set_range(interval *i, double low, double high)
{
    mpq_set_ui(i->low, 0, 1);
    mpq_set_ui(i->high, 0, 1);
    i->no_low = low < -DBL_MAX;
    i->no_high = high > DBL_MAX;
    if (!i->no_low)
        add(i->low, 1, low);
    if (!i->no_high)
        add(i->high, 1, high);
}

static bool intervals_meet(const interval *a, const interval *b)
{
    return (a->no_low || b->no_high || mpq_cmp(a->low, b->high) <= 0) &&
           (b->no_low || a->no_high || mpq_cmp(b->low, a->high) <= 0);
}

static bool interval_holds(const interval *outer, const interval *inner)
{
    return (outer->no_low || mpq_cmp(outer->low, inner->low) <= 0) &&
           (outer->no_high || mpq_cmp(inner->high, outer->high) <= 0);
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

static bool matches_box(const octree_region *region, const octree_body *body)
{
    interval range, extent;
    begin_interval(&range);
    begin_interval(&extent);
    bool matches = true;
    for (int i = 0; i < 3; i++) {
        const double low = region->box.min[i], high = region->box.max[i];
        set_extent(&extent, body, i);
        matches = matches && low <= DBL_MAX && high >= -DBL_MAX;
        if (!matches)
            break;
        set_range(&range, low, high);
        matches = region->contained ? interval_holds(&range, &extent) : intervals_meet(&range, &extent);
    }
    end_interval(&range);
    end_interval(&extent);
    return matches;
}

bool oracle_overlap(const octree_body *a, const octree_body *b)
{
    interval x, y;
    begin_interval(&x);
    begin_interval(&y);
    bool meet = true;
    for (int i = 0; i < 3 && meet; i++) {
        set_extent(&x, a, i);
        set_extent(&y, b, i);
        meet = intervals_meet(&x, &y);
    }
    end_interval(&x);
    end_interval(&y);
    return meet;
}

/* ---- Distances ---------------------------------------------------------------------------------------------- */

/* Set `square` to the squared distance from a target to the nearest or the farthest point of a body. */
static void set_squared_distance(mpq_t square, const double target[3], const octree_body *body, bool farthest)
{
    interval extent;
    mpq_t below, above;
    begin_interval(&extent);
    mpq_init(below);
    mpq_init(above);
    mpq_set_ui(square, 0, 1);
    for (int i = 0; i < 3; i++) {
        set_extent(&extent, body, i);
        mpq_set_d(below, target[i]);
        mpq_sub(above, below, extent.high); /* how far the target is above the body */
        mpq_sub(below, extent.low, below);  /* and below */
        if (farthest) {
            mpq_neg(above, above);
            mpq_neg(below, below);
        }
        if (mpq_cmp(above, below) > 0)
            mpq_set(below, above);
        if (mpq_sgn(below) < 0)
            continue;
        mpq_mul(below, below, below);
        mpq_add(square, square, below);
    }
    mpq_clear(below);
    mpq_clear(above);
    end_interval(&extent);
}

static bool matches_ball(const octree_region *region, const octree_body *body)
{
    mpq_t square, radius;
    mpq_init(square);
    mpq_init(radius);
    set_squared_distance(square, region->center, body, region->contained);
    add_product(radius, 1, region->radius, region->radius);
    const bool matches = mpq_cmp(square, radius) <= 0;
    mpq_clear(square);
    mpq_clear(radius);
    return matches;
}

int oracle_compare_distances(const double target[3], const octree_body *a, const octree_body *b)
{
    mpq_t x, y;
    mpq_init(x);
    mpq_init(y);
    set_squared_distance(x, target, a, false);
    set_squared_distance(y, target, b, false);
    const int sign = mpq_cmp(x, y);
    mpq_clear(x);
    mpq_clear(y);
    return (sign > 0) - (sign < 0);
}

/* Move a double up or down by some doubles. Below infinity is DBL_MAX. */
static double step(double value, int steps)
{
    if (value > DBL_MAX && steps < 0)
        return step(DBL_MAX, steps + 1);
    for (; steps > 0 && value <= DBL_MAX; steps--)
        value = next_up(value);
    for (; steps < 0 && value >= -DBL_MAX; steps++)
        value = next_down(value);
    return value;
}

/* The sign of value * |value| - square; an infinite value is above all. */
static int compare_square(double value, mpq_t square)
{
    mpq_t own;
    if (value > DBL_MAX)
        return 1;
    mpq_init(own);
    add_product(own, 1, value, fabs(value));
    const int sign = mpq_cmp(own, square);
    mpq_clear(own);
    return sign;
}

bool oracle_distance_is(double value, unsigned steps, const double target[3], const octree_body *body)
{
    mpq_t square;
    mpq_init(square);
    set_squared_distance(square, target, body, false);
    const bool right = value == 0 ? mpq_sgn(square) == 0
                                  : compare_square(step(value, -(int)steps), square) <= 0 &&
                                        compare_square(step(value, (int)steps), square) >= 0;
    mpq_clear(square);
    return right;
}

/* ---- Half-spaces -------------------------------------------------------------------------------------------- */

static bool matches_half_space(const octree_half_space *half_space, const octree_body *body, bool contained)
{
    mpq_t sum;
    mpq_init(sum);
    add(sum, -1, half_space->offset);
    for (int i = 0; i < 3; i++) {
        add_product(sum, 1, half_space->normal[i], body->position[i]);
        add_product(sum, contained ? 1 : -1, fabs(half_space->normal[i]), body->half[i]);
    }
    const bool matches = mpq_sgn(sum) <= 0;
    mpq_clear(sum);
    return matches;
}

static bool matches_half_spaces(const octree_region *region, const octree_body *body)
{
    bool matches = true;
    for (size_t i = 0; i < region->half_space_count; i++)
        matches = matches && matches_half_space(&region->half_spaces[i], body, region->contained);
    return matches;
}

/* ---- Rays and moving boxes ---------------------------------------------------------------------------------- */

/* Set `times` to the times at which the ray is within a body on an axis. Returns false if it never is. */
static bool set_times(interval *times, const octree_region *ray, const octree_body *body, int axis)
{
    const bool is_ray = ray->kind == OCTREE_REGION_RAY;
    const double origin = is_ray ? ray->origin[axis] : ray->from[axis];
    mpq_t speed;
    mpq_init(speed);
    add(speed, 1, is_ray ? ray->direction[axis] : ray->to[axis]);
    if (!is_ray)
        add(speed, -1, ray->from[axis]);
    set_extent(times, body, axis);
    add(times->low, -1, ray->half[axis]);
    add(times->high, 1, ray->half[axis]);
    add(times->low, -1, origin);
    add(times->high, -1, origin);
    const int sign = mpq_sgn(speed);
    const bool ever = sign != 0 || (mpq_sgn(times->low) <= 0 && mpq_sgn(times->high) >= 0);
    times->no_low = times->no_high = sign == 0;
    if (sign != 0) {
        mpq_div(times->low, times->low, speed);
        mpq_div(times->high, times->high, speed);
        if (sign < 0)
            mpq_swap(times->low, times->high);
    }
    mpq_clear(speed);
    return ever;
}

/* Set `first` to the first time of contact. Returns false if there is no contact. */
static bool set_first_time(mpq_t first, const octree_region *ray, const octree_body *body)
{
    interval all, times;
    begin_interval(&all);
    begin_interval(&times);
    set_range(&all, 0, ray->kind == OCTREE_REGION_RAY ? ray->length : 1);
    bool touches = true;
    for (int i = 0; i < 3; i++) {
        touches = set_times(&times, ray, body, i) && touches;
        if (!times.no_low && mpq_cmp(times.low, all.low) > 0)
            mpq_set(all.low, times.low);
        if (!times.no_high && (all.no_high || mpq_cmp(times.high, all.high) < 0)) {
            mpq_set(all.high, times.high);
            all.no_high = false;
        }
    }
    touches = touches && (all.no_high || mpq_cmp(all.low, all.high) <= 0);
    mpq_set(first, all.low);
    end_interval(&all);
    end_interval(&times);
    return touches;
}

static bool matches_ray(const octree_region *region, const octree_body *body)
{
    mpq_t first;
    mpq_init(first);
    const bool touches = set_first_time(first, region, body);
    mpq_clear(first);
    return touches;
}

int oracle_compare_times(const octree_region *ray, const octree_body *a, const octree_body *b)
{
    mpq_t x, y;
    mpq_init(x);
    mpq_init(y);
    set_first_time(x, ray, a);
    set_first_time(y, ray, b);
    const int sign = mpq_cmp(x, y);
    mpq_clear(x);
    mpq_clear(y);
    return (sign > 0) - (sign < 0);
}

bool oracle_time_is(double value, unsigned steps, const octree_region *ray, const octree_body *body)
{
    const double low = step(value, -(int)steps), high = step(value, (int)steps);
    interval near;
    mpq_t first;
    mpq_init(first);
    begin_interval(&near);
    set_first_time(first, ray, body);
    set_range(&near, low, high);
    const bool right =
        (near.no_low || mpq_cmp(near.low, first) <= 0) && (near.no_high || mpq_cmp(first, near.high) <= 0);
    mpq_clear(first);
    end_interval(&near);
    return right;
}

/* ---- All kinds ---------------------------------------------------------------------------------------------- */

bool oracle_matches(const octree_region *region, const octree_body *body)
{
    switch (region->kind) {
    case OCTREE_REGION_BOX:
        return matches_box(region, body);
    case OCTREE_REGION_BALL:
        return matches_ball(region, body);
    case OCTREE_REGION_HALF_SPACES:
        return matches_half_spaces(region, body);
    case OCTREE_REGION_SWEPT:
    case OCTREE_REGION_RAY:
        return matches_ray(region, body);
    case OCTREE_REGION_KINDS:
        break;
    }
    fail();
    return false;
}
