/* SPDX-License-Identifier: MIT */
/* test_cost.c - the cost report equals counts by hand, adds up, is reproducible and optional. */
#include "fixture.h"

#include <math.h>

#include "brute.h"

static bool same_cost(octree_cost a, octree_cost b)
{
    return a.nodes == b.nodes && a.leaves == b.leaves && a.points == b.points && a.pruned == b.pruned &&
           a.taken == b.taken;
}

static void assert_cost(octree_cost found, octree_cost expected)
{
    if (!same_cost(found, expected))
        fail_msg("nodes %d, leaves %d, points %d, pruned %d, taken %d; not %d, %d, %d, %d, %d", (int)found.nodes,
                 (int)found.leaves, (int)found.points, (int)found.pruned, (int)found.taken, (int)expected.nodes,
                 (int)expected.leaves, (int)expected.points, (int)expected.pruned, (int)expected.taken);
}

static bool stop_at_once(const octree_point *point, void *context)
{
    (void)point;
    (void)context;
    return false;
}

static bool ignore(const octree_point *point, void *context)
{
    (void)point;
    (void)context;
    return true;
}

/* Three levels, capacity 1: the root; its octants 0, 4 and 7; the octants 0 and 7 of octant 0. Of six nodes four are
 * leaves: A in 0/0, B in 0/7, C in 7, D in 4. */
static octree *three_levels(void)
{
    octree *tree = make_tree(cube(-8, 8), 1, 21, OCTREE_REFUSE);
    insert_all(tree, (const double[][3]){{-6, -6, -6}, {-2, -2, -2}, {6, 6, 6}, {6, -6, -6}}, 4);
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    assert_int_equal(stats.nodes, 6);
    assert_int_equal(stats.leaves, 4);
    assert_int_equal(stats.depth, 2);
    return tree;
}

static octree_cost cost_of_range(const octree *tree, double low, double high)
{
    octree_cost cost = {0};
    octree_box box = cube(low, high);
    assert_int_equal(octree_range_search(tree, &box, &(octree_search){.cost = &cost}, ignore, NULL), OCTREE_OK);
    return cost;
}

static octree_cost cost_of_radius(const octree *tree, double center, double radius)
{
    octree_cost cost = {0};
    const double at[3] = {center, center, center};
    assert_int_equal(octree_radius(tree, at, radius, &(octree_search){.cost = &cost}, ignore, NULL), OCTREE_OK);
    return cost;
}

static octree_cost cost_of_nearest(const octree *tree, double target, size_t k)
{
    octree_cost cost = {0};
    octree_neighbor found[8];
    size_t count;
    const double at[3] = {target, target, target};
    assert_int_equal(octree_nearest_k(tree, at, k, &(octree_search){.cost = &cost}, found, &count), OCTREE_OK);
    return cost;
}

static void the_cost_of_a_box_equals_a_count_by_hand(void **state)
{
    (void)state;
    octree *tree = three_levels();
    /* Within 0/7: the root, 0 and 0/7 are visited; 4, 7 and 0/0 are left out. */
    assert_cost(cost_of_range(tree, -3, -1), (octree_cost){3, 1, 1, 3, 0});
    /* Within 0/1, which is empty: the root and 0; 4, 7, 0/0 and 0/7 are left out. */
    octree_cost cost = {0};
    const octree_box empty = {{-7, -7, -3}, {-5, -5, -1}};
    assert_int_equal(octree_range_search(tree, &empty, &(octree_search){.cost = &cost}, ignore, NULL), OCTREE_OK);
    assert_cost(cost, (octree_cost){2, 0, 0, 4, 0});
    /* Across the centre, inside no octant: all but 0/0. */
    assert_cost(cost_of_range(tree, -1, 1), (octree_cost){5, 3, 3, 1, 0});
    /* The lowest eighth: 0 is taken whole, and its children are no more than that; 4 and 7 begin where it ends. */
    assert_cost(cost_of_range(tree, -8, 0), (octree_cost){3, 2, 2, 0, 1});
    /* The highest eighth, and one ulp more on each side. */
    assert_cost(cost_of_range(tree, 0, 8), (octree_cost){1, 0, 0, 2, 1});
    assert_cost(cost_of_range(tree, -5e-324, 9), (octree_cost){4, 2, 2, 1, 1});
    octree_destroy(tree);
}

static void the_cost_of_a_ball_equals_a_count_by_hand(void **state)
{
    (void)state;
    octree *tree = three_levels();
    assert_cost(cost_of_radius(tree, -2, 1), (octree_cost){3, 1, 1, 3, 0});
    /* It reaches 4 across x = 0, but 7 is the root of 12 away and 0/0 as well. */
    assert_cost(cost_of_radius(tree, -2, 3), (octree_cost){4, 2, 2, 2, 0});
    octree_destroy(tree);
}

static void the_cost_of_neighbors_equals_a_count_by_hand(void **state)
{
    (void)state;
    octree *tree = three_levels();
    /* B is found first, 0.75 away squared: 0/0 (6.75), 4 (6.25) and 7 (18.75) are left out. */
    assert_cost(cost_of_nearest(tree, -2.5, 1), (octree_cost){3, 1, 1, 3, 0});
    /* B and A, 36.75 away squared: nothing is farther than that. */
    assert_cost(cost_of_nearest(tree, -2.5, 2), (octree_cost){6, 4, 4, 0, 0});
    assert_cost(cost_of_nearest(tree, -2.5, 8), (octree_cost){6, 4, 4, 0, 0});
    /* C first, 3 away squared, all else is farther. */
    assert_cost(cost_of_nearest(tree, 5, 1), (octree_cost){2, 1, 1, 2, 0});
    octree_cost cost = {0};
    octree_neighbor nearest;
    const octree_search how = {.cost = &cost};
    assert_int_equal(octree_nearest_within(tree, (double[3]){-5, -5, 4}, 1, &how, &nearest), OCTREE_NOT_FOUND);
    assert_cost(cost, (octree_cost){1, 0, 0, 3, 0}); /* octant 1 is empty */
    octree_destroy(tree);
}

static void a_range_that_covers_the_tree_takes_its_root_and_compares_no_point(void **state)
{
    (void)state;
    octree *tree = three_levels();
    assert_cost(cost_of_range(tree, -8, 8), (octree_cost){.taken = 1});
    assert_cost(cost_of_radius(tree, 0, 100), (octree_cost){.taken = 1});
    octree_destroy(tree);
}

static void a_query_that_is_refused_costs_nothing(void **state)
{
    (void)state;
    octree *tree = three_levels();
    octree_cost cost = {1, 2, 3, 4, 5};
    const octree_search how = {.cost = &cost}, bad = {.cost = &cost, .epsilon = -1};
    octree_box box = cube(-1, 1);
    octree_neighbor nearest;
    size_t count;
    const double zero[3] = {0};
    assert_int_equal(octree_range_search(tree, &(octree_box){{1, 0, 0}, {0, 0, 0}}, &how, ignore, NULL),
                     OCTREE_BAD_RANGE);
    assert_int_equal(octree_range_search(tree, &box, &bad, ignore, NULL), OCTREE_BAD_SIZE);
    assert_int_equal(octree_radius(tree, zero, -1, &how, ignore, NULL), OCTREE_BAD_SIZE);
    assert_int_equal(octree_radius(tree, zero, 1, &bad, ignore, NULL), OCTREE_BAD_SIZE);
    assert_int_equal(octree_nearest_k(tree, zero, 1, &bad, &nearest, &count), OCTREE_BAD_SIZE);
    assert_int_equal(octree_nearest_within(tree, zero, -1, &how, &nearest), OCTREE_BAD_SIZE);
    assert_cost(cost, (octree_cost){1, 2, 3, 4, 5});
    octree_destroy(tree);
}

static void counts_are_added_to(void **state)
{
    (void)state;
    octree *tree = three_levels();
    octree_cost cost = {100, 200, 300, 400, 500};
    const octree_search how = {.cost = &cost};
    octree_box box = cube(-3, -1);
    octree_neighbor found[2];
    size_t count;
    const double at[3] = {-2, -2, -2}, target[3] = {-2.5, -2.5, -2.5};
    for (int i = 0; i < 2; i++)
        assert_int_equal(octree_range_search(tree, &box, &how, ignore, NULL), OCTREE_OK);
    assert_cost(cost, (octree_cost){106, 202, 302, 406, 500});
    assert_int_equal(octree_radius(tree, at, 1, &how, ignore, NULL), OCTREE_OK);
    assert_cost(cost, (octree_cost){109, 203, 303, 409, 500});
    assert_int_equal(octree_nearest_k(tree, target, 2, &how, found, &count), OCTREE_OK);
    assert_cost(cost, (octree_cost){115, 207, 307, 409, 500});
    octree_destroy(tree);
}

static void a_visitor_that_stops_saves_the_rest(void **state)
{
    (void)state;
    octree *tree = three_levels();
    octree_cost cost = {0};
    const octree_search how = {.cost = &cost};
    octree_box box = cube(-7, -1); /* parts of 0/0 and of 0/7, with both of their points */
    assert_int_equal(octree_range_search(tree, &box, &how, stop_at_once, NULL), OCTREE_OK);
    assert_true(cost.leaves == 1 && cost.points == 1);
    assert_int_equal(octree_radius(tree, (double[3]){-4, -4, -4}, 4, &how, stop_at_once, NULL), OCTREE_OK);
    assert_true(cost.leaves == 2 && cost.points == 2);
    octree_destroy(tree);
}

/* The answers and costs of many queries of each kind, in one digest-like record. */
typedef struct outcome {
    octree_cost range, radius, nearest;
    size_t in_boxes, in_balls;
    uint64_t neighbors;
} outcome;

static bool count_one(const octree_point *point, void *context)
{
    (void)point;
    ++*(size_t *)context;
    return true;
}

static outcome run_queries(const octree *tree, bool with_cost)
{
    outcome all = {.neighbors = 0};
    uint64_t random = 12;
    for (int i = 0; i < 200; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = random_between(&random, -1.2, 1.2);
        double reach = random_between(&random, 0, 0.5);
        octree_box box = {{at[0] - reach, at[1] - reach, at[2] - reach}, {at[0] + reach, at[1] + reach, at[2] + reach}};
        octree_search how = {.cost = with_cost ? &all.range : NULL};
        assert_int_equal(octree_range_search(tree, &box, &how, count_one, &all.in_boxes), OCTREE_OK);
        how.cost = with_cost ? &all.radius : NULL;
        assert_int_equal(octree_radius(tree, at, reach, &how, count_one, &all.in_balls), OCTREE_OK);
        how.cost = with_cost ? &all.nearest : NULL;
        octree_neighbor found[6];
        size_t count;
        assert_int_equal(octree_nearest_k(tree, at, 6, &how, found, &count), OCTREE_OK);
        for (size_t j = 0; j < count; j++)
            all.neighbors = all.neighbors * 1000003 + found[j].point.id;
    }
    return all;
}

static bool same_answers(const outcome *a, const outcome *b)
{
    return a->in_boxes == b->in_boxes && a->in_balls == b->in_balls && a->neighbors == b->neighbors;
}

static bool same_costs(const outcome *a, const outcome *b)
{
    return same_cost(a->range, b->range) && same_cost(a->radius, b->radius) && same_cost(a->nearest, b->nearest);
}

static void capacity_changes_the_cost_and_never_the_answer(void **state)
{
    (void)state;
    octree_box world = cube(-1, 1);
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++) {
        brute all = {0};
        brute_sample(&all, (octree_sample_kind)kind, 8, &world, 1500);
        octree *fine = brute_tree(&all, world, 1, 21), *coarse = brute_tree(&all, world, 64, 21);
        outcome a = run_queries(fine, true), b = run_queries(coarse, true);
        assert_true(same_answers(&a, &b));
        assert_true(a.range.points < b.range.points && a.range.nodes > b.range.nodes);
        assert_true(a.radius.points < b.radius.points && a.radius.nodes > b.radius.nodes);
        assert_true(a.nearest.points < b.nearest.points && a.nearest.nodes > b.nearest.nodes);
        outcome again = run_queries(fine, true), uncounted = run_queries(fine, false);
        assert_true(same_answers(&a, &again) && same_costs(&a, &again));
        assert_true(same_answers(&a, &uncounted));
        octree_destroy(fine);
        octree_destroy(coarse);
        brute_free(&all);
    }
}

static void the_order_of_insertion_does_not_change_the_cost(void **state)
{
    (void)state;
    octree_box world = cube(-1, 1);
    brute all = {0}, reversed = {0};
    brute_sample(&all, OCTREE_SAMPLE_CLUSTERED, 2, &world, 1000);
    for (size_t i = all.count; i-- > 0;)
        brute_collect(&all.points[i], &reversed);
    octree *tree = brute_tree(&all, world, 8, 21), *other = brute_tree(&reversed, world, 8, 21);
    outcome a = run_queries(tree, true), b = run_queries(other, true);
    assert_true(same_answers(&a, &b) && same_costs(&a, &b));
    octree_destroy(tree);
    octree_destroy(other);
    brute_free(&all);
    brute_free(&reversed);
}

static void counts_are_consistent(void **state)
{
    (void)state;
    octree_box world = cube(-1, 1);
    uint64_t random = 31;
    brute all = {0};
    brute_sample(&all, OCTREE_SAMPLE_GAUSSIAN, 3, &world, 800);
    octree *tree = brute_tree(&all, world, 5, 21);
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    for (int i = 0; i < 200; i++) {
        double at = random_between(&random, -1.1, 1.1), reach = random_between(&random, 0, 1);
        const octree_cost costs[] = {cost_of_range(tree, at - reach, at + reach), cost_of_radius(tree, at, reach),
                                     cost_of_nearest(tree, at, 1 + (size_t)i % 8)};
        for (int j = 0; j < 3; j++) {
            assert_true(costs[j].nodes + costs[j].pruned + costs[j].taken <= stats.nodes);
            assert_true(costs[j].leaves <= costs[j].nodes && costs[j].leaves <= stats.leaves);
            assert_true(costs[j].points <= stats.points);
            assert_true(costs[j].pruned + costs[j].taken > 0 || costs[j].nodes == stats.nodes);
        }
    }
    octree_destroy(tree);
    brute_free(&all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cost_of_a_box_equals_a_count_by_hand),
        cmocka_unit_test(the_cost_of_a_ball_equals_a_count_by_hand),
        cmocka_unit_test(the_cost_of_neighbors_equals_a_count_by_hand),
        cmocka_unit_test(a_range_that_covers_the_tree_takes_its_root_and_compares_no_point),
        cmocka_unit_test(a_query_that_is_refused_costs_nothing),
        cmocka_unit_test(counts_are_added_to),
        cmocka_unit_test(a_visitor_that_stops_saves_the_rest),
        cmocka_unit_test(capacity_changes_the_cost_and_never_the_answer),
        cmocka_unit_test(the_order_of_insertion_does_not_change_the_cost),
        cmocka_unit_test(counts_are_consistent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
