/* SPDX-License-Identifier: MIT */
/* test_remove.c - Algorithm 2: removal by position and id, and the merge that follows. */
#include "fixture.h"

#include <math.h>

#include "brute.h"

static void assert_not_removed(octree *tree, const double position[3], uint64_t id, octree_status why)
{
    uint64_t digest = octree_digest(tree);
    uint64_t version = octree_version(tree);
    assert_int_equal(octree_remove(tree, position, id), why);
    assert_true(octree_digest(tree) == digest);
    assert_true(octree_version(tree) == version);
    assert_valid(tree);
}

static void remove_refuses_absent_points(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    const double at[3] = {0.5, 0.5, 0.5};
    assert_not_removed(tree, at, 1, OCTREE_NOT_FOUND); /* empty */
    assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
    assert_not_removed(tree, at, 2, OCTREE_NOT_FOUND);                                  /* another id */
    assert_not_removed(tree, (double[3]){0.5, 0.5, next_up(0.5)}, 1, OCTREE_NOT_FOUND); /* an ulp beside it */
    assert_not_removed(tree, (double[3]){-0.5, 0.5, 0.5}, 1, OCTREE_NOT_FOUND);
    assert_not_removed(tree, (double[3]){0.5, 0.5, NAN}, 1, OCTREE_NOT_FINITE);
    assert_not_removed(tree, (double[3]){INFINITY, 0.5, 0.5}, 1, OCTREE_NOT_FINITE);
    assert_not_removed(tree, (double[3]){0.5, next_up(1), 0.5}, 1, OCTREE_OUTSIDE);
    assert_int_equal(octree_remove(tree, at, 1), OCTREE_OK);
    assert_not_removed(tree, at, 1, OCTREE_NOT_FOUND); /* twice */
    octree_destroy(tree);
}

static void remove_removes_the_id_given_among_coincident_points(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 4, 5, OCTREE_REFUSE);
    const double at[3] = {0.5, 0.5, 0.5};
    for (uint64_t id = 1; id <= 4; id++)
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
    assert_int_equal(octree_remove(tree, at, 3), OCTREE_OK);
    for (uint64_t id = 1; id <= 4; id++)
        assert_true(octree_contains(tree, at, id) == (id != 3));
    octree_destroy(tree);
}

static void remove_treats_plus_zero_as_minus_zero(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_REFUSE);
    for (unsigned stored = 0; stored < 8; stored++)
        for (unsigned named = 0; named < 8; named++) {
            double a[3], b[3];
            for (int axis = 0; axis < 3; axis++) {
                a[axis] = stored >> axis & 1 ? -0.0 : 0.0;
                b[axis] = named >> axis & 1 ? -0.0 : 0.0;
            }
            assert_int_equal(octree_insert(tree, a, 1), OCTREE_OK);
            assert_int_equal(octree_remove(tree, b, 1), OCTREE_OK);
        }
    octree_destroy(tree);
}

static void octants_merge_when_they_fit_one_leaf(void **state)
{
    (void)state;
    static const double at[][3] = {{-4, -4, -4}, {4, 4, 4}, {4, 4, -4}, {-4, 4, 4}};
    octree *tree = make_tree(cube(-8, 8), 2, 5, OCTREE_REFUSE);
    insert_all(tree, at, 4);
    assert_int_equal(node_count(tree), 5);
    assert_int_equal(octree_remove(tree, at[3], 4), OCTREE_OK);
    assert_int_equal(node_count(tree), 4); /* three points, one too many; the empty octant has no node */
    assert_int_equal(octree_remove(tree, at[0], 1), OCTREE_OK);
    assert_int_equal(node_count(tree), 1);
    octree_node root;
    assert_int_equal(octree_node_at(tree, OCTREE_ROOT, &root), OCTREE_OK);
    assert_true(root.leaf);
    assert_int_equal(root.count, 2);
    assert_valid(tree);
    octree_destroy(tree);
}

static void a_merge_climbs_through_all_levels(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(0, 1), 1, 21, OCTREE_REFUSE);
    const double near[3] = {0, 0, 0}, nearer[3] = {0x1p-21, 0, 0};
    assert_int_equal(octree_insert(tree, near, 1), OCTREE_OK);
    assert_int_equal(octree_insert(tree, nearer, 2), OCTREE_OK);
    assert_int_equal(node_count(tree), 23);
    assert_int_equal(octree_remove(tree, near, 1), OCTREE_OK);
    assert_int_equal(node_count(tree), 1);
    assert_valid(tree);
    octree_destroy(tree);
}

static void a_grown_leaf_shrinks_and_merges(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(0, 1), 2, 4, OCTREE_GROW);
    const double at[3] = {0.3, 0.3, 0.3};
    for (uint64_t id = 0; id < 100; id++)
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
    for (uint64_t id = 0; id < 100; id++) {
        assert_int_equal(node_count(tree), id < 98 ? 5 : 1);
        assert_int_equal(octree_remove(tree, at, id * 37 % 100), OCTREE_OK);
        assert_valid(tree);
    }
    assert_int_equal(octree_count(tree), 0);
    octree_destroy(tree);
}

static void removing_all_in_any_order_leaves_an_empty_tree(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        uint64_t random = seed;
        octree *tree = make_tree(cube(-5, 7), 1 + seed % 5, seed % 22, OCTREE_GROW);
        uint64_t empty = octree_digest(tree);
        brute all = {0};
        for (uint64_t id = 0; id < 150; id++) {
            double at[3];
            for (int axis = 0; axis < 3; axis++)
                at[axis] = (double)random_below(&random, 49) / 4 - 5;
            assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
            brute_insert(&all, at, id);
        }
        while (all.count > 0) {
            octree_point point = all.points[random_below(&random, all.count)];
            assert_true(brute_remove(&all, point.position, point.id));
            assert_int_equal(octree_remove(tree, point.position, point.id), OCTREE_OK);
            assert_false(octree_contains(tree, point.position, point.id));
            assert_int_equal(octree_count(tree), all.count);
            assert_valid(tree);
        }
        assert_true(octree_digest(tree) == empty);
        assert_int_equal(node_count(tree), 1);
        brute_free(&all);
        octree_destroy(tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(remove_refuses_absent_points),
        cmocka_unit_test(remove_removes_the_id_given_among_coincident_points),
        cmocka_unit_test(remove_treats_plus_zero_as_minus_zero),
        cmocka_unit_test(octants_merge_when_they_fit_one_leaf),
        cmocka_unit_test(a_merge_climbs_through_all_levels),
        cmocka_unit_test(a_grown_leaf_shrinks_and_merges),
        cmocka_unit_test(removing_all_in_any_order_leaves_an_empty_tree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
