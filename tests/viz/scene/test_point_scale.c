/* SPDX-License-Identifier: MIT */
/* test_point_scale.c - the scale of colours and sizes of painted points: where nearly all of them are, and how far they
 * are from one to the next, whatever the order in which they came. */
#include "scenes.h"
#include "point_scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define GRID 60

static view painting_view(void)
{
    view v = view_default();
    v.point_color = POINTS_BY_HEIGHT;
    return v;
}

/* A plane of points one apart, and outliers far above and below; `step` sets the order. */
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

static void a_few_outliers_do_not_take_the_colours(void **state)
{
    (void)state;
    view v = painting_view();
    octree *tree = make_plane(1);
    assert_true(point_scale_fit(&v, tree, NULL));
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
    assert_true(point_scale_fit(&a, one, NULL) && point_scale_fit(&b, other, NULL));
    assert_memory_equal(&a.point_scale.of, &b.point_scale.of, sizeof a.point_scale.of);
    octree_destroy(one);
    octree_destroy(other);
}

typedef struct low_end {
    double value;
    size_t points;
} low_end;

typedef struct low_ends {
    low_end all[4000];
    size_t count;
} low_ends;

static octree_walk_order add_low_end(const octree_node *node, void *context)
{
    low_ends *ends = context;
    double lowest = INFINITY;
    for (size_t i = 0; node->leaf && i < node->count; i++)
        lowest = fmin(lowest, node->points[i].position[0]);
    if (node->leaf)
        ends->all[ends->count++] = (low_end){lowest, node->count};
    return OCTREE_WALK_ON;
}

static int compare_low_ends(const void *a, const void *b)
{
    const double p = ((const low_end *)a)->value, q = ((const low_end *)b)->value;
    return (p > q) - (p < q);
}

/* Leaves of one to four points, whose x begin at few or at many values: as if all were sorted. */
static void a_hundredth_of_the_points_lies_before_its_low_end(void **state)
{
    (void)state;
    for (uint64_t values = 1; values <= 4096; values *= 4) {
        static low_ends ends;
        view v = painting_view();
        octree_def def = octree_def_default();
        octree *tree;
        size_t at = 0, passed = 0;
        def.world = cube(-1000, 1000);
        def.leaf_capacity = 4;
        ends.count = 0;
        assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
        for (uint64_t i = 0; i < 4000; i++)
            assert_int_equal(
                octree_insert(tree,
                              (double[]){(double)(i * 2654435761 % values) / 8, (double)(i % 63), (double)(i / 63)}, i),
                OCTREE_OK);
        assert_true(point_scale_fit(&v, tree, NULL));
        octree_walk(tree, add_low_end, &ends);
        qsort(ends.all, ends.count, sizeof *ends.all, compare_low_ends);
        for (; passed + ends.all[at].points <= 4000 / 100; at++)
            passed += ends.all[at].points;
        assert_true(v.point_scale.of.low[0] == ends.all[at].value);
        octree_destroy(tree);
    }
}

static void it_is_made_once_and_only_where_points_are_painted(void **state)
{
    (void)state;
    view plain = view_default(), given = painting_view();
    octree *tree = make_plane(1);
    given.point_scale.given = true;
    assert_true(point_scale_fit(&plain, tree, NULL) && point_scale_fit(&given, tree, NULL));
    assert_false(plain.point_scale.given);
    assert_true(given.point_scale.of.high[0] == 0);
    octree_destroy(tree);
}

/* A session that is filmed while it is written has them later. */
static void values_of_points_that_are_not_in_the_tree_do_not_count(void **state)
{
    (void)state;
    view v = painting_view();
    octree *tree = make_plane(1);
    point_values values = {0};
    const double ends[2] = {1, 2};
    v.point_color = POINTS_BY_INTENSITY;
    assert_true(point_values_add(&values,
                                 (point_entry[]){{5, {.intensity = 1, .has[POINT_INTENSITY] = true}},
                                                 {6, {.intensity = 2, .has[POINT_INTENSITY] = true}},
                                                 {1000000, {.intensity = 9, .has[POINT_INTENSITY] = true}}},
                                 3));
    assert_true(point_scale_fit(&v, tree, &values));
    assert_memory_equal(v.point_scale.of.intensities, ends, sizeof ends);
    point_values_release(&values);
    octree_destroy(tree);
}

/* Its numbers are written as JSON. */
static void it_is_finite_in_the_largest_world(void **state)
{
    (void)state;
    view v = painting_view();
    octree_def def = octree_def_default();
    octree *tree;
    def.world = cube(-1.7e308, 1.7e308);
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    assert_true(point_scale_fit(&v, tree, NULL));
    assert_false(v.point_scale.given);
    for (uint64_t i = 0; i < 8; i++) {
        const double at[] = {-1.7e308, 1.7e308};
        const double place[] = {at[i & 1], at[i >> 1 & 1], at[i >> 2 & 1]};
        assert_int_equal(octree_insert(tree, place, i), OCTREE_OK);
    }
    assert_true(point_scale_fit(&v, tree, NULL));
    const double *numbers = v.point_scale.of.low;
    for (size_t i = 0; i < sizeof(point_scale) / sizeof(double); i++)
        assert_true(isfinite(numbers[i]));
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_few_outliers_do_not_take_the_colours),
        cmocka_unit_test(the_order_of_points_does_not_matter),
        cmocka_unit_test(a_hundredth_of_the_points_lies_before_its_low_end),
        cmocka_unit_test(it_is_made_once_and_only_where_points_are_painted),
        cmocka_unit_test(values_of_points_that_are_not_in_the_tree_do_not_count),
        cmocka_unit_test(it_is_finite_in_the_largest_world),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
