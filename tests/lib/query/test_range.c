/* SPDX-License-Identifier: MIT */
/* test_range.c - Algorithm 4: closed boxes, counts, early stops. */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "brute.h"

static bool count_visit(const octree_point *point, void *context)
{
    (void)point;
    ++*(size_t *)context;
    return true;
}

/* The test fails unless both forms of the query refuse this box. */
static void assert_refused(const octree *tree, octree_box box, octree_status why)
{
    size_t visits = 0, count = 0;
    assert_int_equal(octree_range(tree, &box, count_visit, &visits), why);
    assert_int_equal(visits, 0);
    assert_int_equal(octree_range_count(tree, &box, &count), why);
}

/* The number of points in a box, by both forms of the query. */
static size_t points_in(const octree *tree, octree_box box)
{
    size_t visits = 0, count = SIZE_MAX;
    assert_int_equal(octree_range(tree, &box, count_visit, &visits), OCTREE_OK);
    assert_int_equal(octree_range_count(tree, &box, &count), OCTREE_OK);
    assert_int_equal(visits, count);
    return count;
}

static void range_refuses_nan_and_reversed_boxes(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 2, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, 0}, 1), OCTREE_OK);
    for (int axis = 0; axis < 3; axis++) {
        octree_box box = cube(-1, 1);
        box.min[axis] = NAN;
        assert_refused(tree, box, OCTREE_NOT_FINITE);
        box = cube(-1, 1);
        box.max[axis] = NAN;
        assert_refused(tree, box, OCTREE_NOT_FINITE);
        box = cube(-1, 1);
        box.min[axis] = next_up(1);
        assert_refused(tree, box, OCTREE_BAD_RANGE);
        box = cube(-1, 1);
        box.min[axis] = INFINITY;
        box.max[axis] = -INFINITY;
        assert_refused(tree, box, OCTREE_BAD_RANGE);
    }
    octree_destroy(tree);
}

static void range_accepts_infinite_corners(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    static const double at[][3] = {{-1, -1, -1}, {1, 1, 1}, {0, 0, 0}, {0.5, -0.5, 0.25}};
    insert_all(tree, at, 4);
    assert_int_equal(points_in(tree, cube(-INFINITY, INFINITY)), 4);
    assert_int_equal(points_in(tree, cube(-DBL_MAX, DBL_MAX)), 4);
    assert_int_equal(points_in(tree, cube(0, INFINITY)), 2);
    assert_int_equal(points_in(tree, cube(-INFINITY, -1)), 1);
    assert_int_equal(points_in(tree, cube(INFINITY, INFINITY)), 0);
    assert_int_equal(points_in(tree, cube(-INFINITY, -INFINITY)), 0);
    octree_destroy(tree);
}

static void range_is_closed_on_both_ends(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-4, 4), 1, 21, OCTREE_REFUSE);
    const double at[3] = {1.5, -2.25, 0};
    assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
    octree_box exact = {{1.5, -2.25, -0.0}, {1.5, -2.25, 0.0}};
    assert_int_equal(points_in(tree, exact), 1);
    octree_box swapped = {{1.5, -2.25, 0.0}, {1.5, -2.25, -0.0}}; /* min > max by their bits, not by value */
    assert_int_equal(points_in(tree, swapped), 1);
    for (int axis = 0; axis < 3; axis++) {
        octree_box box = exact;
        box.min[axis] = next_up(at[axis]);
        box.max[axis] = 4;
        assert_int_equal(points_in(tree, box), 0);
        box.min[axis] = -4;
        box.max[axis] = next_down(at[axis]);
        assert_int_equal(points_in(tree, box), 0);
    }
    octree_destroy(tree);
}

static void range_of_zero_size_has_the_points_on_it(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(0, 8), 2, 3, OCTREE_GROW);
    for (uint64_t id = 0; id < 10; id++)
        assert_int_equal(octree_insert(tree, (double[3]){4, 4, 4}, id), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){4, 4, next_down(4)}, 10), OCTREE_OK);
    assert_int_equal(points_in(tree, cube(4, 4)), 10);
    assert_int_equal(points_in(tree, cube(next_down(4), 4)), 11);
    assert_int_equal(points_in(tree, cube(5, 5)), 0);
    octree_destroy(tree);
}

static void range_beyond_the_world_is_empty(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    static const double at[][3] = {{-1, -1, -1}, {1, 1, 1}};
    insert_all(tree, at, 2);
    assert_int_equal(points_in(tree, cube(next_up(1), 5)), 0);
    assert_int_equal(points_in(tree, cube(1, 5)), 1);
    assert_int_equal(points_in(tree, cube(-DBL_MAX, -2)), 0);
    octree_destroy(tree);
}

typedef struct stopper {
    size_t left;
    size_t visits;
} stopper;

static bool stop_after(const octree_point *point, void *context)
{
    (void)point;
    stopper *stop = context;
    stop->visits++;
    return --stop->left > 0;
}

static void the_visitor_can_stop_at_any_point(void **state)
{
    (void)state;
    uint64_t random = 3;
    octree *tree = make_tree(cube(0, 1), 3, 21, OCTREE_GROW);
    for (uint64_t id = 0; id < 100; id++) {
        double x = random_between(&random, 0, 1);
        assert_int_equal(octree_insert(tree, (double[3]){x, x * x, id < 30 ? 0.5 : 1 - x}, id), OCTREE_OK);
    }
    octree_box all = cube(0, 1);
    for (size_t n = 1; n <= 100; n++) {
        stopper stop = {n, 0};
        assert_int_equal(octree_range(tree, &all, stop_after, &stop), OCTREE_OK);
        assert_int_equal(stop.visits, n);
    }
    octree_destroy(tree);
}

/* A box whose corners are often on points and planes. */
static octree_box random_box(uint64_t *random)
{
    octree_box box;
    for (int axis = 0; axis < 3; axis++) {
        box.min[axis] = (double)random_below(random, 40) / 2 - 10;
        box.max[axis] = box.min[axis] + (double)random_below(random, 20) / 2;
        if (random_below(random, 4) == 0)
            box.min[axis] = next_up(box.min[axis] - 0.5);
        if (random_below(random, 4) == 0)
            box.max[axis] = next_down(box.max[axis] + 0.5);
    }
    return box;
}

static void range_agrees_with_a_scan(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        uint64_t random = seed;
        octree *tree = make_tree(cube(-8, 8), 1 + (seed - 1) * 3, 1 + seed % 8, OCTREE_GROW);
        brute all = {0};
        for (uint64_t id = 0; id < 500; id++) {
            double at[3];
            for (int axis = 0; axis < 3; axis++)
                at[axis] = (double)random_below(&random, 33) / 2 - 8;
            assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
            brute_insert(&all, at, id);
        }
        for (int i = 0; i < 300; i++) {
            octree_box box = random_box(&random);
            brute expected = {0}, found = {0};
            brute_range(&all, &box, &expected);
            assert_int_equal(octree_range(tree, &box, brute_collect, &found), OCTREE_OK);
            assert_int_equal(points_in(tree, box), expected.count);
            assert_true(brute_equal(&expected, &found));
            brute_free(&expected);
            brute_free(&found);
        }
        brute_free(&all);
        octree_destroy(tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(range_refuses_nan_and_reversed_boxes),
        cmocka_unit_test(range_accepts_infinite_corners),
        cmocka_unit_test(range_is_closed_on_both_ends),
        cmocka_unit_test(range_of_zero_size_has_the_points_on_it),
        cmocka_unit_test(range_beyond_the_world_is_empty),
        cmocka_unit_test(the_visitor_can_stop_at_any_point),
        cmocka_unit_test(range_agrees_with_a_scan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
