/* SPDX-License-Identifier: MIT */
/* test_nearest.c - Algorithms 6 and 7: the true nearest point, ties, and skipped points. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "brute.h"

/* The test fails unless the nearest point is this one, at this distance. */
static void assert_nearest(const octree *tree, const double target[3], octree_skip skip, uint64_t skip_id, uint64_t id,
                           double distance)
{
    octree_neighbor nearest;
    assert_int_equal(octree_nearest(tree, target, skip, skip_id, &nearest), OCTREE_OK);
    if (nearest.point.id != id || nearest.distance != distance)
        fail_msg("nearest is %llu at %.17g, not %llu at %.17g", (unsigned long long)nearest.point.id, nearest.distance,
                 (unsigned long long)id, distance);
}

static void nearest_refuses_bad_targets_and_options(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    octree_neighbor nearest;
    assert_int_equal(octree_nearest(tree, (double[3]){0}, OCTREE_SKIP_NONE, 0, &nearest), OCTREE_NOT_FOUND);
    assert_int_equal(octree_insert(tree, (double[3]){0}, 1), OCTREE_OK);
    static const double values[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 9; i++) {
        double target[3] = {0, 0, 0};
        target[i % 3] = values[i / 3];
        assert_int_equal(octree_nearest(tree, target, OCTREE_SKIP_NONE, 0, &nearest), OCTREE_NOT_FINITE);
    }
    assert_int_equal(octree_nearest(tree, (double[3]){0}, (octree_skip)3, 0, &nearest), OCTREE_BAD_OPTION);
    octree_destroy(tree);
}

static void each_skip_rule_leaves_out_its_points(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 2, 10, OCTREE_GROW);
    const double here[3] = {0, 0, 0};
    assert_int_equal(octree_insert(tree, here, 5), OCTREE_OK);
    assert_int_equal(octree_insert(tree, here, 6), OCTREE_OK);                 /* another id at the same place */
    assert_int_equal(octree_insert(tree, (double[3]){0, 3, 0}, 5), OCTREE_OK); /* the same id elsewhere */
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, -4}, 7), OCTREE_OK);
    assert_nearest(tree, here, OCTREE_SKIP_NONE, 0, 5, 0);
    assert_nearest(tree, here, OCTREE_SKIP_NONE, 5, 5, 0); /* the id is not read */
    assert_nearest(tree, here, OCTREE_SKIP_ID, 5, 6, 0);
    assert_nearest(tree, here, OCTREE_SKIP_ID, 6, 5, 0);
    assert_nearest(tree, here, OCTREE_SKIP_COINCIDENT, 5, 5, 3);
    assert_nearest(tree, (double[3]){-0.0, 0.0, -0.0}, OCTREE_SKIP_COINCIDENT, 0, 5, 3);
    assert_nearest(tree, (double[3]){0, 1, 0}, OCTREE_SKIP_COINCIDENT, 0, 5, 1);
    assert_int_equal(octree_remove(tree, here, 6), OCTREE_OK);
    assert_nearest(tree, here, OCTREE_SKIP_ID, 5, 7, 4);
    octree_destroy(tree);
}

static void a_tree_of_skipped_points_only_returns_not_found(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 1, 3, OCTREE_GROW);
    const double here[3] = {1, 1, 1};
    octree_neighbor nearest;
    for (uint64_t id = 0; id < 5; id++)
        assert_int_equal(octree_insert(tree, here, id), OCTREE_OK);
    assert_int_equal(octree_nearest(tree, here, OCTREE_SKIP_COINCIDENT, 0, &nearest), OCTREE_NOT_FOUND);
    for (uint64_t id = 1; id < 5; id++)
        assert_int_equal(octree_remove(tree, here, id), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){2, 2, 2}, 0), OCTREE_OK);
    assert_int_equal(octree_nearest(tree, here, OCTREE_SKIP_ID, 0, &nearest), OCTREE_NOT_FOUND);
    octree_destroy(tree);
}

static void a_point_whose_squared_distance_underflows_is_not_coincident(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_GROW);
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, 0}, 1), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){0, 1e-170, 0}, 2), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, 0.5}, 3), OCTREE_OK);
    assert_nearest(tree, (double[3]){0}, OCTREE_SKIP_COINCIDENT, 0, 2, 1e-170);
    assert_nearest(tree, (double[3]){0}, OCTREE_SKIP_ID, 1, 2, 1e-170);
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, -5e-324}, 4), OCTREE_OK);
    assert_nearest(tree, (double[3]){0}, OCTREE_SKIP_COINCIDENT, 0, 4, 5e-324);
    octree_destroy(tree);
}

static void ties_go_to_the_lowest_id_wherever_it_lies(void **state)
{
    (void)state;
    static const double around[6][3] = {{3, 0, 0}, {-3, 0, 0}, {0, 3, 0}, {0, -3, 0}, {0, 0, 3}, {0, 0, -3}};
    for (uint64_t lowest = 0; lowest < 6; lowest++)
        for (size_t capacity = 1; capacity <= 8; capacity++) {
            octree *tree = make_tree(cube(-8, 8), capacity, 5, OCTREE_GROW);
            for (uint64_t i = 0; i < 6; i++)
                assert_int_equal(octree_insert(tree, around[i], 10 + (i + 6 - lowest) % 6), OCTREE_OK);
            assert_int_equal(octree_insert(tree, (double[3]){1, 2, 2}, 3), OCTREE_OK); /* 3 away as well */
            assert_nearest(tree, (double[3]){0}, OCTREE_SKIP_NONE, 0, 3, 3);
            assert_int_equal(octree_remove(tree, (double[3]){1, 2, 2}, 3), OCTREE_OK);
            assert_nearest(tree, (double[3]){0}, OCTREE_SKIP_NONE, 0, 10, 3);
            assert_nearest(tree, (double[3]){0}, OCTREE_SKIP_ID, 10, 11, 3);
            octree_destroy(tree);
        }
}

static void the_target_may_lie_anywhere(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 1, 5, OCTREE_REFUSE);
    static const double at[][3] = {{-8, -8, -8}, {8, 8, 8}, {8, -8, 0}, {0, 0, 0}};
    insert_all(tree, at, 4);
    assert_nearest(tree, (double[3]){20, -8, 0}, OCTREE_SKIP_NONE, 0, 3, 12);
    assert_nearest(tree, (double[3]){-8, -8, -1e100}, OCTREE_SKIP_NONE, 0, 1, 1e100);
    assert_nearest(tree, (double[3]){8, 8, DBL_MAX}, OCTREE_SKIP_NONE, 0, 2, DBL_MAX);
    octree_neighbor nearest;
    assert_int_equal(octree_nearest(tree, (double[3]){DBL_MAX, DBL_MAX, DBL_MAX}, OCTREE_SKIP_NONE, 0, &nearest),
                     OCTREE_OK);
    assert_int_equal(nearest.point.id, 2);
    octree_destroy(tree);
}

/* A small exact configuration at a scale: targets and offsets are whole multiples of it. */
static void assert_right_at_scale(double scale, octree_box world)
{
    /* The squares are 25, 26, 17, 17, 17, 17. */
    static const int offsets[][3] = {{5, 0, 0}, {3, 4, 1}, {-2, -2, 3}, {0, 4, -1}, {2, -3, 2}, {-4, 1, 0}};
    octree *tree = make_tree(world, 1, 21, OCTREE_GROW);
    for (uint64_t i = 0; i < 6; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = (8 + offsets[i][axis]) * scale;
        assert_int_equal(octree_insert(tree, at, i + 1), OCTREE_OK);
    }
    const double target[3] = {8 * scale, 8 * scale, 8 * scale};
    octree_neighbor nearest;
    assert_int_equal(octree_nearest(tree, target, OCTREE_SKIP_NONE, 0, &nearest), OCTREE_OK);
    assert_int_equal(nearest.point.id, 3);
    double expected = sqrt(17) * scale;
    assert_true(nearest.distance >= next_down(expected) && nearest.distance <= next_up(expected));
    octree_destroy(tree);
}

static void the_scale_of_the_world_does_not_matter(void **state)
{
    (void)state;
    assert_right_at_scale(1, cube(0, 16));
    assert_right_at_scale(0x1p663, cube(0, 0x1p667));     /* about 1e200: squares overflow */
    assert_right_at_scale(0x1p1019, cube(0, DBL_MAX));    /* about 5e306 */
    assert_right_at_scale(0x1p-663, cube(0, 0x1p-659));   /* about 1e-200: squares underflow */
    assert_right_at_scale(0x1p-1034, cube(0, 0x1p-1030)); /* about 5e-312: subnormal */
    assert_right_at_scale(0x1p-1074, cube(0, 0x1p-1070)); /* the smallest steps there are */
}

static void the_distance_along_one_axis_is_a_rounded_difference(void **state)
{
    (void)state;
    static const double gaps[] = {5e-324, 1e-323, 1.5e-323, 2.5e-323, 3.5e-323, 1e-310, 3e-308,
                                  1e-200, 0.1,    3,        1e200,    1e308,    DBL_MAX};
    for (size_t i = 0; i < sizeof gaps / sizeof gaps[0]; i++)
        for (int axis = 0; axis < 3; axis++) {
            double at[3] = {0, 0, 0};
            at[axis] = gaps[i];
            octree *tree = make_tree(cube(0, DBL_MAX), 1, 21, OCTREE_REFUSE);
            assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
            assert_nearest(tree, (double[3]){0}, OCTREE_SKIP_NONE, 0, 1, gaps[i]);
            octree_destroy(tree);
        }
}

static void nearest_is_the_true_one_where_squares_overflow_or_vanish(void **state)
{
    (void)state;
    /* Plain squares are all infinite, or all zero: only the first met, not the nearest, would be named. */
    static const double scales[] = {0x1p663, 0x1p-663, 0x1p-1040};
    for (size_t s = 0; s < 3; s++) {
        double scale = scales[s];
        octree *tree = make_tree(cube(-1024 * scale, 1024 * scale), 2, 10, OCTREE_GROW);
        brute whole = {0};
        uint64_t random = s;
        for (uint64_t id = 0; id < 300; id++) {
            double at[3], scaled[3];
            for (int axis = 0; axis < 3; axis++) {
                at[axis] = (double)random_below(&random, 2049) - 1024;
                scaled[axis] = at[axis] * scale;
            }
            brute_insert(&whole, at, id);
            assert_int_equal(octree_insert(tree, scaled, id), OCTREE_OK);
        }
        for (int i = 0; i < 200; i++) {
            double at[3], scaled[3];
            for (int axis = 0; axis < 3; axis++) {
                at[axis] = (double)random_below(&random, 4097) - 2048;
                scaled[axis] = at[axis] * scale;
            }
            octree_neighbor expected, nearest;
            assert_true(brute_nearest(&whole, at, OCTREE_SKIP_NONE, 0, &expected));
            assert_int_equal(octree_nearest(tree, scaled, OCTREE_SKIP_NONE, 0, &nearest), OCTREE_OK);
            assert_true(nearest.point.id == expected.point.id);
        }
        brute_free(&whole);
        octree_destroy(tree);
    }
}

static void random_place(uint64_t *random, int64_t reach, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = (double)random_below(random, (uint64_t)(2 * reach + 1)) - (double)reach;
}

static void compare_with_scan(size_t capacity, size_t depth, int64_t reach)
{
    uint64_t random = capacity * 100 + depth;
    octree *tree = make_tree(cube(-20, 20), capacity, depth, OCTREE_GROW);
    brute all = {0};
    for (uint64_t id = 0; id < 250; id++) {
        double at[3];
        random_place(&random, id % 5 == 0 ? 2 : 20, at);
        bool stored = brute_contains(&all, at, id % 200);
        assert_int_equal(octree_insert(tree, at, id % 200), stored ? OCTREE_DUPLICATE : OCTREE_OK);
        if (!stored)
            brute_insert(&all, at, id % 200);
    }
    for (int i = 0; i < 150; i++) {
        double target[3];
        random_place(&random, reach, target);
        octree_skip skip = (octree_skip)(i % 3);
        uint64_t skip_id = random_below(&random, 200);
        octree_neighbor expected, nearest;
        assert_true(brute_nearest(&all, target, skip, skip_id, &expected));
        assert_int_equal(octree_nearest(tree, target, skip, skip_id, &nearest), OCTREE_OK);
        assert_true(nearest.point.id == expected.point.id);
        assert_true(nearest.distance == expected.distance);
    }
    brute_free(&all);
    octree_destroy(tree);
}

static void nearest_agrees_with_a_scan_for_every_depth_and_capacity(void **state)
{
    (void)state;
    for (size_t depth = 0; depth <= 21; depth++)
        compare_with_scan(1 + depth % 4, depth, 25);
    for (size_t capacity = 1; capacity <= 64; capacity += 3)
        compare_with_scan(capacity, 8, 60);
}

/* Beside a plane of a random cell: the nearest point lies just behind it, as good as the leaf's own best. */
static void assert_found_behind_a_plane(const octree_box *world, double size, uint64_t *random)
{
    const int axis = (int)random_below(random, 3), aside = (axis + 1) % 3;
    octree *tree = make_tree(*world, 2, OCTREE_MAX_DEPTH, OCTREE_GROW);
    double target[3], across[3], own[3];
    for (int i = 0; i < 3; i++)
        target[i] = random_between(random, world->min[i] / 2, world->max[i] / 2);
    octree_address address = OCTREE_ROOT;
    for (uint64_t depth = 1 + random_below(random, 9); depth > 0; depth--)
        address = address << 3 | random_below(random, 8);
    const octree_box cell = octree_cell_box(world, address);
    const double plane = cell.min[axis] > world->min[axis] ? cell.min[axis] : cell.max[axis];
    const double reach = ldexp(size, -(int)random_below(random, 12) - 12);
    target[axis] = plane + 0.999 * reach;
    memcpy(across, target, sizeof across);
    memcpy(own, target, sizeof own);
    across[axis] -= 0.9999 * reach;
    own[aside] += 1.0001 * reach;
    assert_int_equal(octree_insert(tree, own, 1), OCTREE_OK);
    for (uint64_t id = 2; id < 20; id++) { /* so that the target's leaf is small, and far below that plane */
        double far[3];
        for (int i = 0; i < 3; i++)
            far[i] = target[i] + reach * random_between(random, i == axis ? 2 : -6, 6);
        assert_int_equal(octree_insert(tree, far, id), OCTREE_OK);
    }
    assert_int_equal(octree_insert(tree, across, 100), OCTREE_OK);
    octree_neighbor nearest;
    assert_int_equal(octree_nearest(tree, target, OCTREE_SKIP_NONE, 0, &nearest), OCTREE_OK);
    assert_int_equal(nearest.point.id, 100);
    octree_destroy(tree);
}

static void a_point_just_behind_any_plane_is_found(void **state)
{
    static const struct {
        double low, high, size;
    } worlds[] = {{-1, 1, 1},
                  {-0.3, 40, 40},
                  {-1e15, 1e15, 1e15},
                  {-1e200, 1e200, 1e200},
                  {-DBL_MAX, DBL_MAX, 0x1p1022},
                  {-1e-300, 1e-300, 1e-300},
                  {-0x1p-1030, 0x1p-1030, 0x1p-1031}};
    uint64_t random = 8;
    (void)state;
    for (size_t i = 0; i < sizeof worlds / sizeof worlds[0]; i++) {
        const octree_box world = cube(worlds[i].low, worlds[i].high);
        for (int round = 0; round < 300; round++)
            assert_found_behind_a_plane(&world, worlds[i].size, &random);
    }
}

/* One point lies on a plane at the end of the target's cell, the other a few ulps farther away on the other side. The
 * node beyond the plane must not be pruned, though its distance is measured in keys, with a greater error. */
static void a_point_on_a_plane_beats_a_point_a_few_ulps_farther_away(void **state)
{
    static const double worlds[][2] = {{-1, 1}, {0.1, 0.7}, {-1000.3, 800.7}, {1e6, 1e6 + 7.7}, {-0x1p80, 0x1.8p80}};
    uint64_t random = 9;
    (void)state;
    for (int round = 0; round < 20000; round++) {
        const double *w = worlds[round % 5];
        const octree_box world = cube(w[0], w[1]);
        octree *tree = make_tree(world, 1, OCTREE_MAX_DEPTH, OCTREE_GROW);
        const octree_box cell = octree_cell_box(&world, 4096 + random_below(&random, 4096));
        const double width = cell.max[0] - cell.min[0];
        double target[3] = {cell.max[0] - random_between(&random, 0.01, 0.3) * width, cell.min[1] + 0.4 * width,
                            cell.min[2] + 0.6 * width};
        double across[3] = {cell.max[0], target[1], target[2]}, own[3] = {0, target[1], target[2]};
        own[0] = target[0] - (across[0] - target[0]);
        for (int i = 0; i < 3; i++)
            own[0] = nextafter(own[0], -INFINITY);
        if (cell.max[0] < world.max[0]) {
            assert_int_equal(octree_insert(tree, own, 1), OCTREE_OK);
            assert_int_equal(octree_insert(tree, across, 2), OCTREE_OK);
            assert_nearest(tree, target, OCTREE_SKIP_NONE, 0, 2, across[0] - target[0]);
        }
        octree_destroy(tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_refuses_bad_targets_and_options),
        cmocka_unit_test(each_skip_rule_leaves_out_its_points),
        cmocka_unit_test(a_tree_of_skipped_points_only_returns_not_found),
        cmocka_unit_test(a_point_whose_squared_distance_underflows_is_not_coincident),
        cmocka_unit_test(ties_go_to_the_lowest_id_wherever_it_lies),
        cmocka_unit_test(the_target_may_lie_anywhere),
        cmocka_unit_test(a_point_just_behind_any_plane_is_found),
        cmocka_unit_test(a_point_on_a_plane_beats_a_point_a_few_ulps_farther_away),
        cmocka_unit_test(the_scale_of_the_world_does_not_matter),
        cmocka_unit_test(the_distance_along_one_axis_is_a_rounded_difference),
        cmocka_unit_test(nearest_is_the_true_one_where_squares_overflow_or_vanish),
        cmocka_unit_test(nearest_agrees_with_a_scan_for_every_depth_and_capacity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
