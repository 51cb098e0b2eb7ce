/* SPDX-License-Identifier: MIT */
/* test_point_scale.c - the ranges of colours and the spacing of painted points: robust against outliers, and
 * independent of the order of the points. */
#include "scenes.h"
#include "point_scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define GRID 60

static view painting_view(void)
{
    view v = view_make_default();
    v.point_color = POINTS_BY_HEIGHT;
    return v;
}

/* A plane of points at a distance of one, and outliers far above and below; `step` determines the order. */
static octree *make_plane(uint64_t step)
{
    const uint64_t count = GRID * GRID;
    octree_def def = octree_def_default();
    octree *tree;
    def.world = cube(-1000, 1000);
    def.leaf_capacity = 64;
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    for (uint64_t i = 0; i < count; i++) {
        const uint64_t n = i * step % count;
        const double x = (double)(n % GRID), y = (double)(n / GRID);
        assert_int_equal(octree_insert(tree, (double[]){x, y, 0.1 * x}, 5 + n), OCTREE_OK);
    }
    for (uint64_t i = 0; i < 4; i++)
        assert_int_equal(octree_insert(tree, (double[]){1, 1, i % 2 ? 900 : -900}, count + 5 + i), OCTREE_OK);
    return tree;
}

static void a_few_outliers_do_not_change_the_range(void **state)
{
    (void)state;
    view v = painting_view();
    octree *tree = make_plane(1);
    assert_true(point_scale_compute(&v, tree, NULL));
    const point_scale *s = &v.point_scale.of;
    assert_true(v.point_scale.given);
    assert_true(s->low[2] >= 0 && s->low[2] < 0.5 && s->high[2] <= 5.9 && s->high[2] > 5.4);
    assert_true(s->low[0] == 0 && s->high[0] == GRID - 1);
    assert_true(s->ids[0] == 5 && s->ids[1] == GRID * GRID + 8);
    assert_true(s->spacing > 0.8 && s->spacing < 1.2);
    octree_destroy(tree);
}

static void the_order_of_points_does_not_matter(void **state)
{
    (void)state;
    view a = painting_view(), b = painting_view();
    octree *one = make_plane(1), *other = make_plane(7);
    assert_true(point_scale_compute(&a, one, NULL) && point_scale_compute(&b, other, NULL));
    assert_memory_equal(&a.point_scale.of, &b.point_scale.of, sizeof a.point_scale.of);
    octree_destroy(one);
    octree_destroy(other);
}

/* For few and many values, with many points; the result does not depend on the tree. */
static void a_hundredth_of_the_points_lies_below_the_range(void **state)
{
    (void)state;
    enum { POINTS = 4000, LEFT_OUT = POINTS / 100 };
    for (uint64_t values = 1; values <= 4096; values *= 4)
        for (size_t capacity = 1; capacity <= POINTS; capacity *= 20) {
            view v = painting_view();
            octree_def def = octree_def_default();
            octree *tree;
            size_t before = 0, with = 0;
            def.world = cube(-1000, 1000);
            def.leaf_capacity = capacity;
            assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
            for (uint64_t i = 0; i < POINTS; i++)
                assert_int_equal(
                    octree_insert(
                        tree, (double[]){(double)(i * 2654435761 % values) / 8, (double)(i % 63), (double)(i / 63)}, i),
                    OCTREE_OK);
            assert_true(point_scale_compute(&v, tree, NULL));
            for (uint64_t i = 0; i < POINTS; i++) {
                const double x = (double)(i * 2654435761 % values) / 8;
                before += x < v.point_scale.of.low[0];
                with += x <= v.point_scale.of.low[0];
            }
            assert_true(before <= LEFT_OUT && LEFT_OUT < with);
            octree_destroy(tree);
        }
}

/* With this number of points, the scale is computed from a sample. */
static void the_range_of_many_points_does_not_depend_on_the_tree(void **state)
{
    (void)state;
    enum { SIDE = 400 };
    static octree_point points[SIDE * SIDE];
    point_scale first = {.spacing = 0};
    for (size_t i = 0; i < SIDE * SIDE; i++)
        points[i] = (octree_point){{(double)(i % SIDE), (double)i / SIDE, (double)(i * 7919 % 100003) / 100003}, i};
    for (size_t capacity = 8; capacity <= SIDE * SIDE; capacity *= 30) {
        view v = painting_view();
        octree_def def = octree_def_default();
        octree *tree;
        def.world = cube(-1000, 1000);
        def.leaf_capacity = capacity;
        assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
        assert_int_equal(octree_insert_many(tree, points, SIDE * SIDE, NULL, NULL), OCTREE_OK);
        assert_true(point_scale_compute(&v, tree, NULL));
        const point_scale *s = &v.point_scale.of;
        first = capacity == 8 ? *s : first;
        assert_memory_equal(s->low, first.low, sizeof first.low);
        assert_memory_equal(s->high, first.high, sizeof first.high);
        assert_true(fabs(s->low[2] - 0.01) < 0.002 && fabs(s->high[2] - 0.99) < 0.002);
        assert_true(fabs(s->low[1] - 4) < 0.8 && fabs(s->high[1] - 396) < 0.8);
        octree_destroy(tree);
    }
}

static void the_scale_is_computed_once_and_only_for_painted_points(void **state)
{
    (void)state;
    view plain = view_make_default(), given = painting_view();
    octree *tree = make_plane(1);
    given.point_scale.given = true;
    assert_true(point_scale_compute(&plain, tree, NULL) && point_scale_compute(&given, tree, NULL));
    assert_false(plain.point_scale.given);
    assert_true(given.point_scale.of.high[0] == 0);
    octree_destroy(tree);
}

/* The values of points that are inserted later may be known already; they must not change the scale. */
static void values_of_points_outside_the_tree_do_not_count(void **state)
{
    (void)state;
    view v = painting_view();
    octree *tree = make_plane(1);
    point_values values = {0};
    const double ends[2] = {1, 2};
    v.point_color = POINTS_BY_INTENSITY;
    assert_true(point_values_add_entries(&values,
                                         (point_entry[]){{5, {.intensity = 1, .has[POINT_INTENSITY] = true}},
                                                         {6, {.intensity = 2, .has[POINT_INTENSITY] = true}},
                                                         {1000000, {.intensity = 9, .has[POINT_INTENSITY] = true}}},
                                         3));
    assert_true(point_scale_compute(&v, tree, &values));
    assert_memory_equal(v.point_scale.of.intensities, ends, sizeof ends);
    point_values_release(&values);
    octree_destroy(tree);
}

/* The numbers are written as JSON, which has no infinities. */
static void the_scale_is_finite_in_the_largest_world(void **state)
{
    (void)state;
    view v = painting_view();
    octree_def def = octree_def_default();
    octree *tree;
    def.world = cube(-1.7e308, 1.7e308);
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    assert_true(point_scale_compute(&v, tree, NULL));
    assert_false(v.point_scale.given);
    for (uint64_t i = 0; i < 8; i++) {
        const double at[] = {-1.7e308, 1.7e308};
        const double place[] = {at[i & 1], at[i >> 1 & 1], at[i >> 2 & 1]};
        assert_int_equal(octree_insert(tree, place, i), OCTREE_OK);
    }
    assert_true(point_scale_compute(&v, tree, NULL));
    const double *numbers = v.point_scale.of.low;
    for (size_t i = 0; i < sizeof(point_scale) / sizeof(double); i++)
        assert_true(isfinite(numbers[i]));
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_few_outliers_do_not_change_the_range),
        cmocka_unit_test(the_order_of_points_does_not_matter),
        cmocka_unit_test(a_hundredth_of_the_points_lies_below_the_range),
        cmocka_unit_test(the_range_of_many_points_does_not_depend_on_the_tree),
        cmocka_unit_test(the_scale_is_computed_once_and_only_for_painted_points),
        cmocka_unit_test(values_of_points_outside_the_tree_do_not_count),
        cmocka_unit_test(the_scale_is_finite_in_the_largest_world),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
