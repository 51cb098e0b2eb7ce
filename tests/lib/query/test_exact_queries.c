/* SPDX-License-Identifier: MIT */
/* test_exact_queries.c - k nearest, balls and the nearest within a radius compared with exact integer arithmetic. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "brute.h"
#include "exact_oracle.h"

/* The test fails unless the k nearest are the true ones in the true order, at distances within four doubles. */
static void assert_nearest_k(const octree *tree, const brute *all, const double target[3], size_t k, octree_skip skip,
                             uint64_t skip_id)
{
    octree_point *sorted = malloc((all->count + 1) * sizeof *sorted);
    octree_neighbor *found = malloc((all->count + 1) * sizeof *found);
    assert_true(sorted != NULL && found != NULL);
    size_t count, left = exact_nearest_sorted(all->points, all->count, target, skip, skip_id, sorted);
    const octree_search how = {.skip = skip, .skip_id = skip_id};
    assert_int_equal(octree_nearest_k(tree, target, k, &how, found, &count), OCTREE_OK);
    assert_int_equal(count, k < left ? k : left);
    for (size_t i = 0; i < count; i++) {
        if (octree_compare_points(&found[i].point, &sorted[i]) != 0)
            fail_msg("number %zu to (%a %a %a) is %llu (%a %a %a), not %llu", i, target[0], target[1], target[2],
                     (unsigned long long)sorted[i].id, sorted[i].position[0], sorted[i].position[1],
                     sorted[i].position[2], (unsigned long long)found[i].point.id);
        assert_true(exact_distance_is(found[i].distance, 4, target, sorted[i].position));
    }
    free(sorted);
    free(found);
}

/* The test fails unless the ball holds exactly what it should, and the nearest in it is the true nearest, or none. */
static void assert_within(const octree *tree, const brute *all, const double center[3], double radius)
{
    brute expected = {0}, found = {0};
    for (size_t i = 0; i < all->count; i++)
        if (exact_compare_radius(center, all->points[i].position, radius, 0) <= 0)
            brute_collect(&all->points[i], &expected);
    assert_int_equal(octree_radius(tree, center, radius, NULL, brute_collect, &found), OCTREE_OK);
    if (!brute_equal(&found, &expected))
        fail_msg("%zu points within %a of (%a %a %a), not %zu", expected.count, radius, center[0], center[1], center[2],
                 found.count);
    const octree_point *truth = exact_nearest(expected.points, expected.count, center, OCTREE_SKIP_NONE, 0);
    octree_neighbor nearest;
    assert_int_equal(octree_nearest_within(tree, center, radius, NULL, &nearest),
                     truth != NULL ? OCTREE_OK : OCTREE_NOT_FOUND);
    if (truth != NULL)
        assert_int_equal(nearest.point.id, truth->id);
    brute_free(&expected);
    brute_free(&found);
}

/* Radii at the distance of one of the points, and the doubles before and after. */
static void assert_all(const octree *tree, const brute *all, const double target[3], uint64_t *random)
{
    size_t n = all->count;
    const size_t asked[] = {1, 2, 5, n - 1, n, n + 1, SIZE_MAX};
    assert_nearest_k(tree, all, target, asked[random_below(random, 7)], (octree_skip)random_below(random, 3),
                     random_below(random, n));
    octree_neighbor *found = malloc(n * sizeof *found);
    assert_non_null(found);
    size_t count;
    assert_int_equal(octree_nearest_k(tree, target, n, NULL, found, &count), OCTREE_OK);
    double radius = found[random_below(random, count)].distance;
    free(found);
    if (!isfinite(radius))
        return;
    assert_within(tree, all, target, radius);
    assert_within(tree, all, target, fmax(next_down(radius), 0));
    assert_within(tree, all, target, fmin(next_up(radius), DBL_MAX));
}

static void add(brute *all, const octree_box *world, const double at[3])
{
    if (box_holds(world, at) && !brute_contains(all, at, all->count / 2))
        brute_insert(all, at, all->count / 2); /* an id lies at two places */
}

/* The target plus or minus an offset on each axis, and up to one ulp more: a near tie with its mirror images. */
static void add_mirrored(brute *all, const octree_box *world, const double target[3], const double offset[3],
                         uint64_t *random)
{
    double at[3];
    for (int axis = 0; axis < 3; axis++) {
        at[axis] = random_below(random, 2) == 0 ? target[axis] + offset[axis] : target[axis] - offset[axis];
        uint64_t nudge = random_below(random, 4);
        at[axis] = nudge == 0 ? next_up(at[axis]) : nudge == 1 ? next_down(at[axis]) : at[axis];
    }
    add(all, world, at);
}

static void mirrored_ties_in(octree_box world, uint64_t seed)
{
    uint64_t random = seed;
    for (size_t i = 0; i < 50; i++) {
        brute all = {0};
        double target[3], offset[3];
        for (int axis = 0; axis < 3; axis++) {
            double quarter = world.max[axis] / 4 - world.min[axis] / 4;
            double middle = world.min[axis] / 2 + world.max[axis] / 2;
            target[axis] = random_between(&random, middle - quarter / 2, middle + quarter / 2);
            offset[axis] = random_between(&random, 0, quarter);
        }
        for (int mirror = 0; mirror < 16; mirror++)
            add_mirrored(&all, &world, target, offset, &random);
        add(&all, &world, target);
        octree *tree = brute_tree(&all, world, 1 + i % 4, 21);
        for (int j = 0; j < 3; j++)
            assert_all(tree, &all, target, &random);
        octree_destroy(tree);
        brute_free(&all);
    }
}

static void mirrored_near_ties_are_in_their_true_order(void **state)
{
    (void)state;
    mirrored_ties_in(cube(-1, 1), 1);
    mirrored_ties_in(cube(0.1, 1000), 2);
    mirrored_ties_in((octree_box){{-1000, 1e15, -1e-3}, {1000, 1e15 + 1024, 1e-3}}, 3);
}

/* Around the target: more near ties than the search keeps undecided, at two distances, and a few single points. */
static void many_near_ties_are_in_their_true_order_for_every_k(void **state)
{
    (void)state;
    const octree_box world = cube(0.1, 1000);
    const double target[3] = {300.1, 400.7, 500.3};
    static const double offsets[][3] = {{0.3, 0.7, 0.1}, {0.7, 0.3, 0.1}, {0.1, 0.3, 0.7}, {20.3, 5.1, 90}};
    uint64_t random = 19;
    for (size_t ties = 1; ties <= 64; ties += 7) {
        brute all = {0};
        for (size_t i = 0; i < 60 + ties; i++)
            add_mirrored(&all, &world, target, offsets[i < ties ? i % 3 : 3], &random);
        for (int i = 0; i < 6; i++)
            add(&all, &world, (double[3]){target[0] + random_between(&random, 0, 3), target[1], target[2]});
        octree *tree = brute_tree(&all, world, 1 + ties, 21);
        for (size_t k = 1; k <= 40; k++)
            assert_nearest_k(tree, &all, target, k, (octree_skip)(k % 3), k);
        octree_destroy(tree);
        brute_free(&all);
    }
}

static void the_largest_worlds_are_answered_exactly(void **state)
{
    (void)state;
    mirrored_ties_in(cube(-1e200, 1e200), 4);
    mirrored_ties_in(cube(-DBL_MAX, DBL_MAX), 5);
    mirrored_ties_in(cube(1e308, DBL_MAX), 6);
    mirrored_ties_in((octree_box){{-DBL_MAX, -1, 0}, {DBL_MAX, 1, 1e-300}}, 7);
}

static void the_smallest_worlds_are_answered_exactly(void **state)
{
    (void)state;
    mirrored_ties_in(cube(-1e-200, 1e-200), 8);
    mirrored_ties_in(cube(5e-324, 1e-310), 9);
    mirrored_ties_in(cube(0, 1e-321), 10);
    mirrored_ties_in(cube(-0x1p-1022, 0x1p-1021), 11);
    mirrored_ties_in((octree_box){{-1, 1e-200, 5e-324}, {1, 1e-199, 1e-310}}, 12);
}

static void a_lattice_of_tenths_is_answered_exactly(void **state)
{
    (void)state;
    uint64_t random = 13;
    octree_box world = cube(0, 1);
    brute all = {0};
    for (int i = 0; i < 343; i++)
        add(&all, &world, (double[3]){i % 7 * 0.1, i / 7 % 7 * 0.1, i / 49 * 0.1});
    octree *tree = brute_tree(&all, world, 3, 21);
    for (int i = 0; i < 60; i++) {
        double target[3];
        for (int axis = 0; axis < 3; axis++)
            target[axis] = (double)random_below(&random, 16) * 0.05 - 0.05; /* on points, halfway, outside */
        assert_all(tree, &all, target, &random);
    }
    octree_destroy(tree);
    brute_free(&all);
}

static void targets_far_outside_are_answered_exactly(void **state)
{
    (void)state;
    static const double far[] = {1e3, 1e16, 1e154, 1e155, 1e200, 1e300, DBL_MAX};
    static const double extents[] = {1, 1e-300, 1e200};
    uint64_t random = 14;
    for (size_t e = 0; e < 3; e++) {
        octree_box world = cube(-extents[e], extents[e]);
        brute all = {0};
        brute_sample(&all, OCTREE_SAMPLE_UNIFORM, 3, &world, 80);
        octree *tree = brute_tree(&all, world, 2, 21);
        for (int i = 0; i < 60; i++) {
            double target[3];
            for (int axis = 0; axis < 3; axis++)
                target[axis] = (random_below(&random, 3) == 0 ? 1 : far[random_below(&random, 7)]) *
                               (random_below(&random, 2) == 0 ? -1.0 : 1.0);
            assert_all(tree, &all, target, &random);
        }
        octree_destroy(tree);
        brute_free(&all);
    }
}

static void every_magnitude_in_one_tree_is_answered_exactly(void **state)
{
    (void)state;
    uint64_t random = 15;
    octree_box world = cube(-DBL_MAX, DBL_MAX);
    brute all = {0};
    for (int i = 0; i < 150; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = ldexp(random_between(&random, -1, 1), (int)random_below(&random, 2098) - 1074);
        add(&all, &world, at);
    }
    octree *tree = brute_tree(&all, world, 2, 21);
    for (int i = 0; i < 100; i++) {
        double target[3];
        for (int axis = 0; axis < 3; axis++)
            target[axis] = ldexp(random_between(&random, -1, 1), (int)random_below(&random, 2098) - 1074);
        assert_all(tree, &all, target, &random);
        assert_all(tree, &all, all.points[random_below(&random, all.count)].position, &random);
    }
    octree_destroy(tree);
    brute_free(&all);
}

static void distances_whose_squares_underflow_are_distinguished(void **state)
{
    (void)state;
    uint64_t random = 18;
    for (int exponent = -480; exponent >= -560; exponent -= 2) {
        octree_box world = cube(-1, 1);
        brute all = {0};
        for (int i = 0; i < 30; i++) {
            double at[3];
            for (int axis = 0; axis < 3; axis++)
                at[axis] = ldexp(random_between(&random, -1, 1), exponent);
            add(&all, &world, at);
        }
        octree *tree = brute_tree(&all, world, 1 + (size_t)(-exponent) % 5, 21);
        for (int i = 0; i < 10; i++) {
            const double *at = all.points[random_below(&random, all.count)].position;
            const double target[3] = {at[0] * 0.75, at[1] * 0.75, at[2] * -0.75};
            assert_all(tree, &all, target, &random);
        }
        octree_destroy(tree);
        brute_free(&all);
    }
}

static double random_magnitude(uint64_t *random)
{
    static const int scales[] = {0, 0, 0, 53, -53, 660, -660, 1023, -1060};
    return ldexp(random_between(random, -1, 1), scales[random_below(random, 9)]);
}

static void a_sphere_is_decided_by_whole_numbers(void **state)
{
    (void)state;
    uint64_t random = 16;
    for (int i = 0; i < 3000; i++) {
        double center[3], at[3], most = 0;
        for (int axis = 0; axis < 3; axis++) {
            center[axis] = random_magnitude(&random);
            at[axis] = random_below(&random, 2) == 0 ? center[axis] : random_magnitude(&random);
            most = fmax(most, fabs(at[axis] / 2 - center[axis] / 2) * 2);
        }
        double radius = random_below(&random, 2) == 0
                            ? most
                            : hypot(hypot(at[0] - center[0], at[1] - center[1]), at[2] - center[2]);
        uint64_t nudge = random_below(&random, 3);
        radius = nudge == 0 ? next_up(radius) : nudge == 1 ? fmax(next_down(radius), 0) : radius;
        if (!isfinite(radius))
            continue;
        brute all = {0};
        brute_insert(&all, at, 0);
        octree *tree = brute_tree(&all, cube(-DBL_MAX, DBL_MAX), 1, 21);
        assert_within(tree, &all, center, radius);
        octree_destroy(tree);
        brute_free(&all);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mirrored_near_ties_are_in_their_true_order),
        cmocka_unit_test(many_near_ties_are_in_their_true_order_for_every_k),
        cmocka_unit_test(the_largest_worlds_are_answered_exactly),
        cmocka_unit_test(the_smallest_worlds_are_answered_exactly),
        cmocka_unit_test(a_lattice_of_tenths_is_answered_exactly),
        cmocka_unit_test(targets_far_outside_are_answered_exactly),
        cmocka_unit_test(every_magnitude_in_one_tree_is_answered_exactly),
        cmocka_unit_test(distances_whose_squares_underflow_are_distinguished),
        cmocka_unit_test(a_sphere_is_decided_by_whole_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
