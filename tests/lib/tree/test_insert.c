/* SPDX-License-Identifier: MIT */
/* test_insert.c - Algorithm 1: which points are accepted or refused, and the leaf that receives them. */
#include "fixture.h"

#include <math.h>

#include "octree/sample.h"

/* The test fails unless inserting this gives this status and changes nothing. */
static void assert_refused(octree *tree, const double position[3], uint64_t id, octree_status why)
{
    uint64_t digest = octree_digest(tree);
    uint64_t version = octree_version(tree);
    size_t count = octree_count(tree);
    assert_int_equal(octree_insert(tree, position, id), why);
    assert_true(octree_digest(tree) == digest);
    assert_true(octree_version(tree) == version);
    assert_int_equal(octree_count(tree), count);
    assert_valid(tree);
}

static void insert_refuses_every_pattern_of_numbers_that_are_not_finite(void **state)
{
    (void)state;
    static const double values[] = {0.5, NAN, INFINITY, -INFINITY};
    octree *tree = make_tree(cube(-1, 1), 2, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, 0}, 1), OCTREE_OK);
    for (int pattern = 1; pattern < 64; pattern++) {
        double at[3] = {values[pattern & 3], values[pattern >> 2 & 3], values[pattern >> 4]};
        assert_refused(tree, at, 2, OCTREE_NOT_FINITE);
    }
    octree_destroy(tree);
}

static void insert_refuses_point_outside_world_by_one_ulp(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-7, 11), 2, 5, OCTREE_REFUSE);
    for (int axis = 0; axis < 3; axis++) {
        double low[3] = {1, 1, 1}, high[3] = {1, 1, 1};
        low[axis] = next_down(-7);
        high[axis] = next_up(11);
        assert_refused(tree, low, 1, OCTREE_OUTSIDE);
        assert_refused(tree, high, 1, OCTREE_OUTSIDE);
        low[axis] = -1e308;
        high[axis] = 1e308;
        assert_refused(tree, low, 1, OCTREE_OUTSIDE);
        assert_refused(tree, high, 1, OCTREE_OUTSIDE);
    }
    octree_destroy(tree);
}

static void insert_accepts_the_faces_edges_and_corners_of_the_world(void **state)
{
    (void)state;
    static const double values[] = {-7, 2, 11};
    octree *tree = make_tree(cube(-7, 11), 1, 21, OCTREE_REFUSE);
    for (uint64_t id = 0; id < 27; id++) {
        double at[3] = {values[id % 3], values[id / 3 % 3], values[id / 9]};
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
        assert_true(octree_contains(tree, at, id));
    }
    assert_int_equal(octree_count(tree), 27);
    assert_valid(tree);
    octree_destroy(tree);
}

static void insert_refuses_a_stored_pair_and_accepts_another_id(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 4, 5, OCTREE_REFUSE);
    const double at[3] = {0.25, 0.0, -0.5};
    assert_int_equal(octree_insert(tree, at, 7), OCTREE_OK);
    assert_refused(tree, at, 7, OCTREE_DUPLICATE);
    assert_refused(tree, (double[3]){0.25, -0.0, -0.5}, 7, OCTREE_DUPLICATE);
    assert_int_equal(octree_insert(tree, at, 8), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){0.25, 0.25, -0.5}, 7), OCTREE_OK);
    assert_int_equal(octree_count(tree), 3);
    octree_destroy(tree);
}

static void insert_returns_duplicate_rather_than_full(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 2, 3, OCTREE_REFUSE);
    const double at[3] = {0.25, 0.25, 0.25};
    assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
    assert_int_equal(octree_insert(tree, at, 2), OCTREE_OK);
    assert_refused(tree, at, 3, OCTREE_FULL);
    assert_refused(tree, at, 2, OCTREE_DUPLICATE);
    octree_destroy(tree);
}

static void extreme_ids_are_valid(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_GROW);
    const double at[3] = {0.1, 0.2, 0.3};
    static const uint64_t ids[] = {0, 1, UINT64_MAX, UINT64_MAX - 1, UINT64_C(1) << 63, UINT64_C(1) << 32};
    for (size_t i = 0; i < sizeof ids / sizeof ids[0]; i++) {
        assert_int_equal(octree_insert(tree, at, ids[i]), OCTREE_OK);
        assert_refused(tree, at, ids[i], OCTREE_DUPLICATE);
    }
    for (size_t i = 0; i < sizeof ids / sizeof ids[0]; i++)
        assert_true(octree_contains(tree, at, ids[i]));
    octree_destroy(tree);
}

static void a_leaf_splits_when_it_meets_one_point_too_many(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 2, 5, OCTREE_REFUSE);
    static const double at[][3] = {{-4, -4, -4}, {4, 4, 4}, {4, 4, -4}};
    insert_all(tree, at, 2);
    assert_int_equal(node_count(tree), 1);
    assert_int_equal(octree_insert(tree, at[2], 3), OCTREE_OK);
    assert_int_equal(node_count(tree), 4); /* the root and its three occupied octants */
    octree_node root;
    assert_int_equal(octree_node_at(tree, OCTREE_ROOT, &root), OCTREE_OK);
    assert_false(root.leaf);
    assert_int_equal(root.octants, 1u << 0 | 1u << 7 | 1u << 6);
    assert_int_equal(root.count, 3);
    octree_destroy(tree);
}

static void a_point_goes_to_the_octant_of_equation_one(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 1, 1, OCTREE_GROW);
    static const double values[] = {-0.0, 0.0, -5e-324, 5e-324, -3, 3};
    assert_int_equal(octree_insert(tree, (double[3]){-8, -8, -8}, 1000), OCTREE_OK);
    for (uint64_t id = 0; id < 216; id++) {
        double at[3] = {values[id % 6], values[id / 6 % 6], values[id / 36]};
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
        octree_node leaf;
        assert_int_equal(octree_locate(tree, at, &leaf), OCTREE_OK);
        unsigned octant = (at[0] >= 0 ? 4u : 0) + (at[1] >= 0 ? 2u : 0) + (at[2] >= 0 ? 1u : 0);
        assert_int_equal(leaf.address, 8 + octant);
    }
    assert_int_equal(octree_count(tree), 217);
    assert_valid(tree);
    octree_destroy(tree);
}

static void a_full_leaf_at_the_maximum_depth_refuses_or_grows(void **state)
{
    (void)state;
    for (size_t depth = 0; depth <= 21; depth++) {
        octree *refuses = make_tree(cube(0, 1), 3, depth, OCTREE_REFUSE);
        octree *grows = make_tree(cube(0, 1), 3, depth, OCTREE_GROW);
        const double at[3] = {0.3, 0.6, 0.9};
        for (uint64_t id = 0; id < 3; id++) {
            assert_int_equal(octree_insert(refuses, at, id), OCTREE_OK);
            assert_int_equal(octree_insert(grows, at, id), OCTREE_OK);
        }
        assert_refused(refuses, at, 3, OCTREE_FULL);
        assert_int_equal(node_count(refuses), 1); /* a refusal leaves no subdivision behind, unlike the paper's */
        assert_int_equal(octree_insert(grows, at, 3), OCTREE_OK);
        assert_int_equal(node_count(grows), depth + 1);
        assert_valid(grows);
        octree_destroy(refuses);
        octree_destroy(grows);
    }
}

static void cells_narrower_than_an_ulp_end_the_splitting(void **state)
{
    (void)state;
    static const octree_box worlds[] = {
        {{1e15, 1e15, 1e15}, {1e15 + 1, 1e15 + 1, 1e15 + 1}}, /* eight steps of an eighth: three splits */
        {{0, 0, 0}, {5e-324, 5e-324, 5e-324}},                /* no double lies strictly inside */
        {{1, 1, 1}, {1 + 0x1p-52, 1 + 0x1p-52, 1 + 0x1p-52}},
    };
    static const size_t deepest[] = {3, 0, 0};
    for (size_t i = 0; i < 3; i++) {
        octree *tree = make_tree(worlds[i], 1, 21, OCTREE_REFUSE);
        assert_int_equal(octree_insert(tree, worlds[i].min, 1), OCTREE_OK);
        assert_refused(tree, worlds[i].min, 2, OCTREE_FULL);
        octree_destroy(tree);
        tree = make_tree(worlds[i], 1, 21, OCTREE_GROW);
        assert_int_equal(octree_insert(tree, worlds[i].min, 1), OCTREE_OK);
        assert_int_equal(octree_insert(tree, worlds[i].min, 2), OCTREE_OK);
        assert_int_equal(octree_insert(tree, worlds[i].max, 3), OCTREE_OK);
        octree_stats stats;
        assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
        assert_int_equal(stats.depth, deepest[i]);
        assert_valid(tree);
        octree_destroy(tree);
    }
}

static void an_exhausted_axis_does_not_stop_the_others(void **state)
{
    (void)state;
    octree_box world = {{1e15, 0, 0}, {1e15 + 1, 1000, 1000}};
    octree *tree = make_tree(world, 1, 21, OCTREE_REFUSE);
    /* Far closer on y than the third split, where x is exhausted; the same x. */
    assert_int_equal(octree_insert(tree, (double[3]){1e15, 100, 100}, 1), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){1e15, 100.5, 100}, 2), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){1e15, 100.5, 100.001}, 3), OCTREE_OK);
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    assert_true(stats.depth > 10);
    assert_valid(tree);
    octree_destroy(tree);
}

static void the_version_changes_with_every_insertion(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(0, 1), 2, 21, OCTREE_REFUSE);
    uint64_t random = 5;
    for (uint64_t id = 0; id < 200; id++) {
        uint64_t version = octree_version(tree);
        double at[3] = {octree_random_unit(&random), octree_random_unit(&random), octree_random_unit(&random)};
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
        assert_true(octree_version(tree) != version);
        assert_valid(tree);
    }
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(insert_refuses_every_pattern_of_numbers_that_are_not_finite),
        cmocka_unit_test(insert_refuses_point_outside_world_by_one_ulp),
        cmocka_unit_test(insert_accepts_the_faces_edges_and_corners_of_the_world),
        cmocka_unit_test(insert_refuses_a_stored_pair_and_accepts_another_id),
        cmocka_unit_test(insert_returns_duplicate_rather_than_full),
        cmocka_unit_test(extreme_ids_are_valid),
        cmocka_unit_test(a_leaf_splits_when_it_meets_one_point_too_many),
        cmocka_unit_test(a_point_goes_to_the_octant_of_equation_one),
        cmocka_unit_test(a_full_leaf_at_the_maximum_depth_refuses_or_grows),
        cmocka_unit_test(cells_narrower_than_an_ulp_end_the_splitting),
        cmocka_unit_test(an_exhausted_axis_does_not_stop_the_others),
        cmocka_unit_test(the_version_changes_with_every_insertion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
