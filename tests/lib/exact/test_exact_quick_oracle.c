/* SPDX-License-Identifier: MIT */
/* test_exact_quick_oracle.c - the quick oracle agrees with the exact oracle at every scale, near ties included. */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "brute.h"
#include "exact_oracle.h"
#include "octree/sample.h"
#include "quick_oracle.h"

static double random_magnitude(uint64_t *random)
{
    static const int scales[] = {0, 0, 0, 0, 53, -53, 660, -660, 1023, -1060};
    const int scale = scales[random_below(random, 10)];
    return ldexp(random_between(random, -1, 1), scale);
}

static double nudged(double value, uint64_t *random)
{
    const uint64_t nudge = random_below(random, 4);
    value = nudge == 0 ? next_up(value) : nudge == 1 ? next_down(value) : value;
    return fmin(fmax(value, -DBL_MAX), DBL_MAX);
}

/* A place, another, and one that is as far from the first, or nearly so. */
static void near_tie(uint64_t *random, double target[3], double a[3], double b[3])
{
    const bool about_zero = random_below(random, 4) == 0; /* then mirroring is exact */
    for (int axis = 0; axis < 3; axis++) {
        target[axis] = about_zero ? 0 : random_magnitude(random);
        a[axis] = random_magnitude(random);
        const double mirrored = 2 * (target[axis] - a[axis] / 2);
        const double there = !isfinite(mirrored) ? a[axis] : about_zero ? -a[axis] : mirrored;
        b[axis] = nudged(there, random);
    }
}

enum { TRIALS = 6000 };

static void distances_are_compared_alike(void **state)
{
    (void)state;
    uint64_t random = 1;
    size_t signs[3] = {0};
    for (int i = 0; i < TRIALS; i++) {
        double target[3], a[3], b[3];
        near_tie(&random, target, a, b);
        const int order = exact_compare(target, a, b);
        signs[order + 1]++;
        assert_int_equal(quick_compare(target, a, b), order);
        const double ratio = ldexp(octree_random_unit(&random), -(int)random_below(&random, 60));
        assert_int_equal(quick_compare_ratio(target, a, b, ratio), exact_compare_ratio(target, a, b, ratio));
        const double length = fabs(random_magnitude(&random));
        assert_int_equal(quick_compare_longer(target, a, b, length), exact_compare_longer(target, a, b, length));
    }
    assert_true(signs[0] > 100 && signs[1] > 100 && signs[2] > 100);
}

/* The distance as doubles have it, and those beside it. */
static void radii_and_distances_are_decided_alike(void **state)
{
    (void)state;
    uint64_t random = 2;
    size_t rights = 0;
    for (int i = 0; i < TRIALS; i++) {
        double target[3], a[3], b[3];
        near_tie(&random, target, a, b);
        double distance = hypot(hypot(a[0] - target[0], a[1] - target[1]), a[2] - target[2]);
        for (uint64_t left = random_below(&random, 4); left > 0; left--)
            distance = fmax(nudged(distance, &random), 0);
        if (!isfinite(distance))
            continue;
        const double part = distance * octree_random_unit(&random);
        assert_int_equal(quick_compare_radius(target, a, distance, 0), exact_compare_radius(target, a, distance, 0));
        assert_int_equal(quick_compare_radius(target, a, part, distance - part),
                         exact_compare_radius(target, a, part, distance - part));
        const bool right = exact_distance_is(distance, 2, target, a);
        rights += right;
        assert_int_equal(quick_distance_is(distance, 2, target, a), right);
    }
    assert_true(rights > TRIALS / 4 && rights < TRIALS - 100);
}

static void boxes_are_decided_alike(void **state)
{
    (void)state;
    uint64_t random = 3;
    size_t hits = 0;
    for (int i = 0; i < TRIALS; i++) {
        double from[3], to[3], p[3];
        const double size = fabs(random_magnitude(&random)), moment = (double)random_below(&random, 5) / 4;
        for (int axis = 0; axis < 3; axis++) {
            const double sides[] = {-size, size, 0};
            from[axis] = random_magnitude(&random);
            to[axis] = random_below(&random, 4) == 0 ? from[axis] : random_magnitude(&random);
            p[axis] = nudged(from[axis] * (1 - moment) + to[axis] * moment + sides[random_below(&random, 3)], &random);
        }
        const bool touches = exact_touches(from, to, size, p, p, NULL);
        hits += touches;
        assert_int_equal(quick_touches(from, to, size, p), touches);
        assert_int_equal(quick_within(from[0], size, p[0]), exact_within(from[0], size, p[0]));
        assert_int_equal(brute_is_within(from[0], size, p[0]), exact_within(from[0], size, p[0]));
    }
    assert_true(hits > TRIALS / 10 && hits < TRIALS * 9 / 10);
}

/* A sum that rounds to the largest double beside one that does not fit: TwoSum would overflow here. */
static void a_box_as_large_as_doubles_allow_is_decided_alike(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int i = 0; i < TRIALS; i++) {
        const double center = ldexp(random_between(&random, -1, 1), 1023 - (int)random_below(&random, 60));
        const double size = random_below(&random, 2) == 0 ? DBL_MAX : next_down(DBL_MAX);
        const double p = nudged(center < 0 ? center + size : center - size, &random);
        assert_int_equal(brute_is_within(center, size, p), exact_within(center, size, p));
        assert_int_equal(quick_within(center, size, p), exact_within(center, size, p));
    }
}

/* Mirror images of one place about the target, some of them a double beside it, some twice: ties and near ties. */
static void the_nearest_are_picked_alike(void **state)
{
    (void)state;
    enum { POINTS = 60 };
    uint64_t random = 5;
    for (int i = 0; i < 300; i++) {
        const double target[3] = {0, 0, 0};
        const double place[3] = {random_magnitude(&random), random_magnitude(&random), random_magnitude(&random)};
        octree_point points[POINTS], sorted[POINTS];
        for (size_t j = 0; j < POINTS; j++) {
            points[j].id = octree_random(&random);
            for (int axis = 0; axis < 3; axis++) {
                const double turned = random_below(&random, 2) == 0 ? place[axis] : -place[axis];
                points[j].position[axis] = random_below(&random, 4) == 0 ? nudged(turned, &random) : turned;
            }
        }
        const octree_point *nearest[QUICK_NEAREST_MOST];
        const size_t k = 1 + random_below(&random, QUICK_NEAREST_MOST), count = 1 + random_below(&random, POINTS);
        assert_int_equal(exact_nearest_sorted(points, count, target, OCTREE_SKIP_NONE, 0, sorted), count);
        quick_nearest_k(points, count, target, k, nearest);
        for (size_t j = 0; j < k && j < count; j++)
            assert_int_equal(nearest[j]->id, sorted[j].id);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_compared_alike),
        cmocka_unit_test(radii_and_distances_are_decided_alike),
        cmocka_unit_test(boxes_are_decided_alike),
        cmocka_unit_test(a_box_as_large_as_doubles_allow_is_decided_alike),
        cmocka_unit_test(the_nearest_are_picked_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
