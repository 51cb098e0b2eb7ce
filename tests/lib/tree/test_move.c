/* SPDX-License-Identifier: MIT */
/* test_move.c - octree_move(): a point arrives or stays where it was. */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "brute.h"

static void assert_stays(octree *tree, const double from[3], uint64_t id, const double to[3], octree_status why)
{
    uint64_t digest = octree_digest(tree);
    uint64_t version = octree_version(tree);
    assert_int_equal(octree_move(tree, from, id, to), why);
    assert_true(octree_digest(tree) == digest);
    assert_true(octree_version(tree) == version);
    assert_valid(tree);
}

static void move_refuses_what_insert_or_remove_would_refuse(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    const double at[3] = {0.5, 0.5, 0.5}, to[3] = {-0.5, -0.5, -0.5};
    assert_stays(tree, at, 1, to, OCTREE_NOT_FOUND);
    assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
    assert_stays(tree, at, 2, to, OCTREE_NOT_FOUND);
    assert_stays(tree, to, 1, at, OCTREE_NOT_FOUND);
    assert_stays(tree, at, 1, (double[3]){0, 0, NAN}, OCTREE_NOT_FINITE);
    assert_stays(tree, (double[3]){NAN, 0, 0}, 1, to, OCTREE_NOT_FINITE);
    assert_stays(tree, at, 1, (double[3]){0, -INFINITY, 0}, OCTREE_NOT_FINITE);
    assert_stays(tree, at, 1, (double[3]){0, next_up(1), 0}, OCTREE_OUTSIDE);
    assert_stays(tree, (double[3]){0, 2, 0}, 1, to, OCTREE_OUTSIDE);
    octree_destroy(tree);
}

static void move_refuses_a_full_leaf_and_stays(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 2, OCTREE_REFUSE);
    const double taken[3] = {0.9, 0.9, 0.9}, near[3] = {0.8, 0.8, 0.8}, far[3] = {-0.9, -0.9, -0.9};
    assert_int_equal(octree_insert(tree, taken, 1), OCTREE_OK);
    assert_int_equal(octree_insert(tree, far, 2), OCTREE_OK);
    assert_stays(tree, far, 2, near, OCTREE_FULL);
    assert_stays(tree, far, 2, taken, OCTREE_FULL);
    octree_destroy(tree);
}

static void move_refuses_a_pair_that_is_stored(void **state)
{
    (void)state;
    const double a[3] = {0.5, 0.5, 0.5}, b[3] = {-0.5, -0.5, -0.5}, c[3] = {0.5, 0.5, 0.625};
    for (size_t capacity = 1; capacity <= 4; capacity += 3) { /* in three leaves, and in one */
        octree *tree = make_tree(cube(-1, 1), capacity, 5, OCTREE_GROW);
        assert_int_equal(octree_insert(tree, a, 1), OCTREE_OK);
        assert_int_equal(octree_insert(tree, b, 1), OCTREE_OK);
        assert_int_equal(octree_insert(tree, c, 1), OCTREE_OK);
        assert_stays(tree, a, 1, b, OCTREE_DUPLICATE);
        assert_stays(tree, a, 1, c, OCTREE_DUPLICATE);
        assert_int_equal(octree_insert(tree, b, 2), OCTREE_OK);
        assert_int_equal(octree_move(tree, b, 2, a), OCTREE_OK); /* another id at the same place is no duplicate */
        octree_destroy(tree);
    }
}

static void move_within_a_full_leaf_always_succeeds(void **state)
{
    (void)state;
    for (size_t depth = 0; depth <= 3; depth++) {
        octree *tree = make_tree(cube(0, 16), 3, depth, OCTREE_REFUSE);
        const double at[3] = {1, 1, 1}, to[3] = {1.5, 0.5, 1.25};
        for (uint64_t id = 0; id < 3; id++)
            assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
        assert_int_equal(octree_insert(tree, at, 3), OCTREE_FULL);
        for (uint64_t id = 0; id < 3; id++) {
            assert_int_equal(octree_move(tree, at, id, to), OCTREE_OK);
            assert_false(octree_contains(tree, at, id));
            assert_true(octree_contains(tree, to, id));
            assert_valid(tree);
        }
        octree_destroy(tree);
    }
}

static void move_to_the_same_place_succeeds(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 2, OCTREE_REFUSE);
    const double at[3] = {0, 0.5, 0.5};
    assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
    uint64_t digest = octree_digest(tree);
    assert_int_equal(octree_move(tree, at, 1, at), OCTREE_OK);
    assert_int_equal(octree_move(tree, at, 1, (double[3]){-0.0, 0.5, 0.5}), OCTREE_OK);
    assert_true(octree_contains(tree, at, 1));
    assert_int_equal(octree_count(tree), 1);
    assert_true(octree_digest(tree) == digest);
    octree_destroy(tree);
}

static void move_into_the_sibling_that_a_full_tree_leaves_free(void **state)
{
    (void)state;
    /* Capacity 1, depth 1: eight places for eight points. Each moves to the place that is free. */
    octree *tree = make_tree(cube(-1, 1), 1, 1, OCTREE_REFUSE);
    double at[8][3];
    for (int i = 0; i < 8; i++) {
        for (int axis = 0; axis < 3; axis++)
            at[i][axis] = i >> axis & 1 ? 0.5 : -0.5;
        if (i > 0)
            assert_int_equal(octree_insert(tree, at[i], (uint64_t)i), OCTREE_OK);
    }
    assert_stays(tree, at[1], 1, at[2], OCTREE_FULL);
    for (int i = 1; i < 8; i++) {
        assert_int_equal(octree_move(tree, at[i], (uint64_t)i, at[i - 1]), OCTREE_OK);
        assert_valid(tree);
    }
    octree_destroy(tree);
}

static void the_leaf_that_is_left_merges(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 2, 10, OCTREE_REFUSE);
    static const double at[][3] = {{-4, -4, -4}, {4, 4, 4}, {4.0625, 4, 4}, {4, 4.0625, 4}};
    insert_all(tree, at, 4);
    octree_stats before, after;
    assert_int_equal(octree_statistics(tree, &before), OCTREE_OK);
    assert_int_equal(octree_move(tree, at[3], 4, (double[3]){-5, -4, -4}), OCTREE_OK);
    assert_int_equal(octree_statistics(tree, &after), OCTREE_OK);
    assert_true(after.nodes < before.nodes);
    assert_int_equal(after.nodes, 3);
    assert_valid(tree);
    octree_destroy(tree);
}

/* A random place on a coarse grid, so that places are often taken. */
static void random_place(uint64_t *random, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = (double)random_below(random, 9) - 4;
}

static void move_is_removal_and_insertion_or_nothing(void **state)
{
    (void)state;
    uint64_t random = 11;
    octree *moved = make_tree(cube(-4, 4), 2, 4, OCTREE_REFUSE);
    brute all = {0};
    for (uint64_t id = 0; id < 120; id++) {
        double at[3];
        random_place(&random, at);
        if (octree_insert(moved, at, id) == OCTREE_OK)
            brute_insert(&all, at, id);
    }
    for (int i = 0; i < 3000; i++) {
        octree_point *point = &all.points[random_below(&random, all.count)];
        double to[3];
        random_place(&random, to);
        uint64_t digest = octree_digest(moved);
        octree_status status = octree_move(moved, point->position, point->id, to);
        assert_true(status == OCTREE_OK || status == OCTREE_FULL);
        if (status == OCTREE_OK)
            memcpy(point->position, to, sizeof to);
        else
            assert_true(octree_digest(moved) == digest);
        assert_valid(moved);
    }
    octree *rebuilt = make_tree(cube(-4, 4), 2, 4, OCTREE_REFUSE);
    for (size_t i = 0; i < all.count; i++)
        assert_int_equal(octree_insert(rebuilt, all.points[i].position, all.points[i].id), OCTREE_OK);
    assert_true(octree_digest(rebuilt) == octree_digest(moved));
    brute_free(&all);
    octree_destroy(moved);
    octree_destroy(rebuilt);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(move_refuses_what_insert_or_remove_would_refuse),
        cmocka_unit_test(move_refuses_a_full_leaf_and_stays),
        cmocka_unit_test(move_refuses_a_pair_that_is_stored),
        cmocka_unit_test(move_within_a_full_leaf_always_succeeds),
        cmocka_unit_test(move_to_the_same_place_succeeds),
        cmocka_unit_test(move_into_the_sibling_that_a_full_tree_leaves_free),
        cmocka_unit_test(the_leaf_that_is_left_merges),
        cmocka_unit_test(move_is_removal_and_insertion_or_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
