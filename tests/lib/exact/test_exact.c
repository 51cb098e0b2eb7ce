/* SPDX-License-Identifier: MIT */
/* test_exact.c - nearest neighbours, collisions and distances compared with exact integer arithmetic. */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "brute.h"
#include "exact_oracle.h"

/* The test fails unless the tree names the true nearest point, and a distance within two doubles of the real one. */
static void assert_exact(const octree *tree, const brute *all, const double target[3], octree_skip skip,
                         uint64_t skip_id)
{
    const octree_point *truth = exact_nearest(all->points, all->count, target, skip, skip_id);
    octree_neighbor ours;
    octree_status status = octree_nearest(tree, target, skip, skip_id, &ours);
    assert_int_equal(status, truth != NULL ? OCTREE_OK : OCTREE_NOT_FOUND);
    if (truth == NULL)
        return;
    if (ours.point.id != truth->id)
        fail_msg("nearest to (%.17g %.17g %.17g) is %llu (%.17g %.17g %.17g), not %llu", target[0], target[1],
                 target[2], (unsigned long long)truth->id, truth->position[0], truth->position[1], truth->position[2],
                 (unsigned long long)ours.point.id);
    if (!exact_distance_is(ours.distance, 2, target, truth->position))
        fail_msg("the distance is not %.17g", ours.distance);
}

static void add(octree *tree, brute *all, const double at[3])
{
    octree_def def = octree_definition(tree);
    if (!box_holds(&def.world, at))
        return;
    assert_int_equal(octree_insert(tree, at, all->count), OCTREE_OK);
    brute_insert(all, at, all->count);
}

/* The target plus or minus an offset on each axis, and up to one ulp more: a near tie with its mirror images. */
static void add_mirrored(octree *tree, brute *all, const double target[3], const double offset[3], uint64_t *random)
{
    double at[3];
    for (int axis = 0; axis < 3; axis++) {
        at[axis] = random_below(random, 2) == 0 ? target[axis] + offset[axis] : target[axis] - offset[axis];
        uint64_t nudge = random_below(random, 4);
        at[axis] = nudge == 0 ? next_up(at[axis]) : nudge == 1 ? next_down(at[axis]) : at[axis];
    }
    add(tree, all, at);
}

static void near_ties_in(octree_box world, uint64_t seed)
{
    uint64_t random = seed;
    for (int i = 0; i < 150; i++) {
        octree *tree = make_tree(world, 1 + seed % 4, 21, OCTREE_GROW);
        brute all = {0};
        double target[3], offset[3];
        for (int axis = 0; axis < 3; axis++) {
            double quarter = world.max[axis] / 4 - world.min[axis] / 4;
            double middle = world.min[axis] / 2 + world.max[axis] / 2;
            target[axis] = random_between(&random, middle - quarter / 2, middle + quarter / 2);
            offset[axis] = random_between(&random, 0, quarter);
        }
        for (int mirror = 0; mirror < 12; mirror++)
            add_mirrored(tree, &all, target, offset, &random);
        assert_exact(tree, &all, target, OCTREE_SKIP_NONE, 0);
        assert_exact(tree, &all, target, OCTREE_SKIP_ID, random_below(&random, 12));
        assert_exact(tree, &all, target, OCTREE_SKIP_COINCIDENT, 0);
        brute_free(&all);
        octree_destroy(tree);
    }
}

static void nearest_is_the_true_one_among_mirrored_near_ties(void **state)
{
    (void)state;
    near_ties_in(cube(-1, 1), 1);
    near_ties_in(cube(0.1, 1000), 2);
    near_ties_in((octree_box){{-1000, 1e15, -1e-3}, {1000, 1e15 + 1024, 1e-3}}, 3);
}

static void nearest_is_the_true_one_at_the_largest_scales(void **state)
{
    (void)state;
    near_ties_in(cube(-1e200, 1e200), 4);
    near_ties_in(cube(-DBL_MAX, DBL_MAX), 5);
    near_ties_in(cube(1e308, DBL_MAX), 6);
    near_ties_in((octree_box){{-DBL_MAX, -1, 0}, {DBL_MAX, 1, 1e-300}}, 7);
}

static void nearest_is_the_true_one_at_the_smallest_scales(void **state)
{
    (void)state;
    near_ties_in(cube(-1e-200, 1e-200), 8);
    near_ties_in(cube(5e-324, 1e-310), 9);
    near_ties_in(cube(0, 1e-321), 10);
    near_ties_in(cube(-0x1p-1022, 0x1p-1021), 11);
    near_ties_in((octree_box){{-1, 1e-200, 5e-324}, {1, 1e-199, 1e-310}}, 12);
}

static void nearest_is_the_true_one_on_a_lattice_of_tenths(void **state)
{
    (void)state;
    uint64_t random = 13;
    octree *tree = make_tree(cube(0, 1), 3, 21, OCTREE_GROW);
    brute all = {0};
    for (int i = 0; i < 1331; i++) {
        double at[3] = {i % 11 * 0.1, i / 11 % 11 * 0.1, i / 121 * 0.1};
        add(tree, &all, at);
    }
    assert_true(all.count >= 1000); /* 10 * 0.1 is 1 */
    for (int i = 0; i < 600; i++) {
        double target[3];
        for (int axis = 0; axis < 3; axis++)
            target[axis] = (double)random_below(&random, 24) * 0.05 - 0.05; /* on points, halfway, outside */
        assert_exact(tree, &all, target, (octree_skip)(i % 3), random_below(&random, 1331));
    }
    brute_free(&all);
    octree_destroy(tree);
}

static void nearest_is_the_true_one_for_targets_far_outside(void **state)
{
    (void)state;
    static const double far[] = {1e3, 1e9, 1e16, 1e154, 1e155, 1e200, DBL_MAX};
    uint64_t random = 14;
    octree *tree = make_tree(cube(-1, 1), 2, 21, OCTREE_GROW);
    brute all = {0};
    for (int i = 0; i < 120; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = random_between(&random, -1, 1);
        add(tree, &all, at);
    }
    for (int i = 0; i < 400; i++) {
        double target[3];
        for (int axis = 0; axis < 3; axis++)
            target[axis] = (random_below(&random, 3) == 0 ? 1 : far[random_below(&random, 7)]) *
                           (random_below(&random, 2) == 0 ? -1.0 : 1.0);
        assert_exact(tree, &all, target, OCTREE_SKIP_NONE, 0);
    }
    brute_free(&all);
    octree_destroy(tree);
}

static void nearest_distinguishes_points_of_every_magnitude_in_one_tree(void **state)
{
    (void)state;
    uint64_t random = 15;
    octree *tree = make_tree(cube(-DBL_MAX, DBL_MAX), 2, 21, OCTREE_GROW);
    brute all = {0};
    for (int i = 0; i < 150; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = ldexp(random_between(&random, -1, 1), (int)random_below(&random, 2098) - 1074);
        add(tree, &all, at);
    }
    for (int i = 0; i < 300; i++) {
        double target[3];
        for (int axis = 0; axis < 3; axis++)
            target[axis] = ldexp(random_between(&random, -1, 1), (int)random_below(&random, 2098) - 1074);
        assert_exact(tree, &all, target, OCTREE_SKIP_NONE, 0);
        assert_exact(tree, &all, all.points[random_below(&random, all.count)].position, OCTREE_SKIP_COINCIDENT, 0);
    }
    brute_free(&all);
    octree_destroy(tree);
}

static double random_magnitude(uint64_t *random)
{
    static const int scales[] = {0, 0, 0, 53, -53, 660, -660, 1023, -1060};
    return ldexp(random_between(random, -1, 1), scales[random_below(random, 9)]);
}

static void collisions_are_decided_by_whole_numbers(void **state)
{
    (void)state;
    uint64_t random = 16;
    for (int i = 0; i < 4000; i++) {
        double center = random_magnitude(&random), size = fabs(random_magnitude(&random));
        double p = center + (random_below(&random, 2) == 0 ? size : -size);
        uint64_t nudge = random_below(&random, 3);
        p = nudge == 0 ? next_up(p) : nudge == 1 ? next_down(p) : p;
        if (!isfinite(p))
            continue;
        bool within = exact_within(center, size, p);
        assert_true(brute_is_within(center, size, p) == within); /* the oracle of test_collide.c */
        octree *tree = make_tree(cube(-DBL_MAX, DBL_MAX), 1, 21, OCTREE_GROW);
        brute found = {0};
        assert_int_equal(octree_insert(tree, (double[3]){1, p, 1}, 1), OCTREE_OK);
        assert_int_equal(octree_collide(tree, (double[3]){1, center, 1}, size, NULL, brute_collect, &found), OCTREE_OK);
        assert_int_equal(found.count, within ? 1 : 0);
        brute_free(&found);
        octree_destroy(tree);
    }
}

/* Large coordinates that are equal say nothing of the distance: it may be a few of the least doubles. */
static void distances_beside_large_coordinates_are_not_rounded(void **state)
{
    (void)state;
    static const double gaps[] = {5e-324, 3 * 5e-324, 7 * 5e-324, 0x1.8p-1022, 0x1p-1000, 1e-200, 1};
    static const double large[] = {1, 0x1p1001, 1e308, DBL_MAX};
    for (size_t i = 0; i < sizeof gaps / sizeof gaps[0]; i++)
        for (size_t j = 0; j < sizeof large / sizeof large[0]; j++) {
            octree *tree = make_tree(cube(-DBL_MAX, DBL_MAX), 4, 21, OCTREE_GROW);
            brute all = {0};
            add(tree, &all, (const double[3]){large[j], -large[j], gaps[i]});
            assert_exact(tree, &all, (const double[3]){large[j], -large[j], 0}, OCTREE_SKIP_NONE, 0);
            assert_exact(tree, &all, (const double[3]){large[j], -large[j], -gaps[i]}, OCTREE_SKIP_NONE, 0);
            octree_destroy(tree);
            brute_free(&all);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_is_the_true_one_among_mirrored_near_ties),
        cmocka_unit_test(nearest_is_the_true_one_at_the_largest_scales),
        cmocka_unit_test(nearest_is_the_true_one_at_the_smallest_scales),
        cmocka_unit_test(nearest_is_the_true_one_on_a_lattice_of_tenths),
        cmocka_unit_test(nearest_is_the_true_one_for_targets_far_outside),
        cmocka_unit_test(nearest_distinguishes_points_of_every_magnitude_in_one_tree),
        cmocka_unit_test(collisions_are_decided_by_whole_numbers),
        cmocka_unit_test(distances_beside_large_coordinates_are_not_rounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
