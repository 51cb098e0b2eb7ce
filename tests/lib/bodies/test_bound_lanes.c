/* SPDX-License-Identifier: MIT */
/* test_bound_lanes.c - four lanes give the same bounds and masks as two, bit by bit, whatever the numbers are. */
#include "fixture.h"
#include "bounds.h"
#include "octree/sample.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef OCTREE_AVX2
enum { TRIALS = 20000, MOST_POINTS = 64 };

/* Numbers of a scene, and rarely those at the edges. */
static double random_number(uint64_t *random)
{
    static const double edges[] = {0, -0.0, HUGE_VAL, -HUGE_VAL, NAN, DBL_MAX, -DBL_MAX, 0x1p-1074, 0x1p900};
    if (random_below(random, 50) == 0)
        return edges[random_below(random, sizeof edges / sizeof edges[0])];
    return random_between(random, -8, 8);
}

static query_bounds make_query(uint64_t *random)
{
    query_bounds b = {.length = random_number(random), .unsure = random_below(random, 4) ? -HUGE_VAL : HUGE_VAL};
    for (int k = 0; k < 3; k++) {
        double *numbers = (double *)&b.axes[k];
        for (size_t i = 0; i < sizeof b.axes[k] / sizeof(double); i++)
            numbers[i] = random_number(random);
        b.axes[k].step *= 0x1p-10 / (double)(1 << 10 * k);
    }
    return b;
}

/* The points end with their memory, so that sanitizers see whether others are read. */
static octree_point *make_points(uint64_t *random, unsigned count)
{
    octree_point *points = malloc(count * sizeof *points);
    assert_non_null(points);
    for (unsigned i = 0; i < count; i++) {
        points[i].id = octree_random(random);
        for (int k = 0; k < 3; k++)
            points[i].position[k] = random_between(random, -8, 8);
    }
    return points;
}

/* The bounds of bodies that are not in the mask do not count. */
static void assert_same_bounds(const double *a, const double *b, uint64_t mask)
{
    for (; mask; mask &= mask - 1)
        assert_memory_equal(&a[bits_lowest(mask)], &b[bits_lowest(mask)], sizeof *a);
}

static void bodies_have_the_same_bounds(void **state)
{
    const bound_functions *two = &bounds_in_two_lanes, *four = &bounds_in_four_lanes;
    uint64_t random = 5;
    (void)state;
    for (int trial = 0; trial < TRIALS; trial++) {
        const unsigned count = 1 + (unsigned)random_below(&random, MOST_POINTS);
        const query_bounds b = make_query(&random);
        const double cut = random_number(&random);
        double x[MOST_POINTS], y[MOST_POINTS];
        octree_point *points = make_points(&random, count);
        const uint64_t near = two->squares(&b, points, count, cut, x);
        assert_int_equal(four->squares(&b, points, count, cut, y), near);
        assert_same_bounds(x, y, near);
        const uint64_t touched = two->times(&b, points, count, cut, x);
        assert_int_equal(four->times(&b, points, count, cut, y), touched);
        assert_same_bounds(x, y, touched);
        const body_masks masks = two->meets(&b, points, count), others = four->meets(&b, points, count);
        assert_int_equal(others.near, masks.near);
        assert_int_equal(others.sure, masks.sure);
        free(points);
    }
}

static void boxes_have_the_same_bounds(void **state)
{
    const bound_functions *two = &bounds_in_two_lanes, *four = &bounds_in_four_lanes;
    uint64_t random = 6;
    (void)state;
    for (int trial = 0; trial < TRIALS; trial++) {
        octree_box boxes[8];
        const sibling_boxes siblings = {boxes, 1 + (unsigned)random_below(&random, 8)};
        const query_bounds b = make_query(&random);
        const double cut = random_number(&random);
        double x[8], y[8];
        for (unsigned i = 0; i < siblings.count; i++)
            for (int k = 0; k < 3; k++) {
                boxes[i].min[k] = random_number(&random);
                boxes[i].max[k] = random_number(&random);
            }
        const unsigned near = two->squares_of_boxes(&b, &siblings, cut, x);
        assert_int_equal(four->squares_of_boxes(&b, &siblings, cut, y), near);
        assert_same_bounds(x, y, near);
        const unsigned touched = two->times_of_boxes(&b, &siblings, cut, x);
        assert_int_equal(four->times_of_boxes(&b, &siblings, cut, y), touched);
        assert_same_bounds(x, y, touched);
        assert_int_equal(four->boxes_meet(&b, &siblings), two->boxes_meet(&b, &siblings));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_have_the_same_bounds),
        cmocka_unit_test(boxes_have_the_same_bounds),
    };
    if (!__builtin_cpu_supports("avx2")) {
        puts("this processor has no AVX2");
        return 77;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    puts("Octreel has no code for AVX2 with this compiler or for this processor");
    return 77;
}
#endif
