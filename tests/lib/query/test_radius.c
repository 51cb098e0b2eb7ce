/* SPDX-License-Identifier: MIT */
/* test_radius.c - the points in a closed ball and the nearest within a radius, by exact comparison. */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "brute.h"

static size_t count_within(const octree *tree, const double center[3], double radius)
{
    brute found = {0};
    assert_int_equal(octree_radius(tree, center, radius, NULL, brute_collect, &found), OCTREE_OK);
    size_t count = found.count;
    brute_free(&found);
    return count;
}

static octree_status within(const octree *tree, const double target[3], double radius)
{
    octree_neighbor nearest;
    return octree_nearest_within(tree, target, radius, NULL, &nearest);
}

/* The test fails unless exactly the `expected` points, each once, are within the radius, and the nearest of them is
 * found, or none. */
static void assert_within(const octree *tree, const double center[3], double radius, brute *expected)
{
    brute found = {0};
    assert_int_equal(octree_radius(tree, center, radius, NULL, brute_collect, &found), OCTREE_OK);
    assert_true(brute_equal(&found, expected));
    brute_free(&found);
    octree_neighbor nearest, truth;
    octree_status status = octree_nearest_within(tree, center, radius, NULL, &nearest);
    if (!brute_nearest(expected, center, OCTREE_SKIP_NONE, 0, &truth)) {
        assert_int_equal(status, OCTREE_NOT_FOUND);
        return;
    }
    assert_int_equal(status, OCTREE_OK);
    assert_true(nearest.point.id == truth.point.id && nearest.distance == truth.distance);
}

static void radius_and_within_refuse_invalid_arguments(void **state)
{
    (void)state;
    static const struct {
        double radius;
        octree_search how;
        octree_status status;
    } cases[] = {
        {NAN, {0}, OCTREE_NOT_FINITE},
        {INFINITY, {0}, OCTREE_NOT_FINITE},
        {-INFINITY, {0}, OCTREE_NOT_FINITE},
        {-1, {0}, OCTREE_BAD_SIZE},
        {-5e-324, {0}, OCTREE_BAD_SIZE},
        {-DBL_MAX, {0}, OCTREE_BAD_SIZE},
        {1, {.epsilon = NAN}, OCTREE_NOT_FINITE},
        {1, {.epsilon = INFINITY}, OCTREE_NOT_FINITE},
        {1, {.epsilon = -5e-324}, OCTREE_BAD_SIZE},
        {1, {.mode = (octree_mode)2}, OCTREE_BAD_OPTION},
        {1, {.skip = (octree_skip)3}, OCTREE_BAD_OPTION},
        {-0.0, {.epsilon = -0.0}, OCTREE_OK},
        {DBL_MAX, {.epsilon = DBL_MAX}, OCTREE_OK},
    };
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    insert_all(tree, (const double[][3]){{0, 0, 0}, {1, 1, 1}}, 2);
    const double zero[3] = {0};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        brute found = {0};
        octree_neighbor nearest;
        assert_int_equal(octree_radius(tree, zero, cases[i].radius, &cases[i].how, brute_collect, &found),
                         cases[i].status);
        assert_int_equal(octree_nearest_within(tree, zero, cases[i].radius, &cases[i].how, &nearest), cases[i].status);
        assert_true((found.count == 0) == (cases[i].status != OCTREE_OK));
        brute_free(&found);
    }
    static const double values[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 9; i++) {
        double center[3] = {0, 0, 0};
        center[i % 3] = values[i / 3];
        assert_int_equal(octree_radius(tree, center, 1, NULL, brute_collect, NULL), OCTREE_NOT_FINITE);
        assert_int_equal(within(tree, center, 1), OCTREE_NOT_FINITE);
    }
    octree_destroy(tree);
}

static void the_sphere_itself_is_within(void **state)
{
    (void)state;
    /* Whole distances along an axis, in a plane and in space; a scale that is a power of two keeps them exact. */
    static const double at[][3] = {{7, 0, 0}, {0, 0, -7}, {3, 4, 0}, {0, -5, 12}, {1, 2, 2}, {-2, 3, 6}, {2, 10, 11}};
    static const double distances[] = {7, 7, 5, 13, 3, 7, 15};
    static const double scales[] = {1, 0x1p-1070, 0x1p-663, 0x1p663, 0x1p1019};
    for (size_t s = 0; s < sizeof scales / sizeof scales[0]; s++)
        for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
            octree *tree = make_tree(cube(-16 * scales[s], 16 * scales[s]), 1, 21, OCTREE_REFUSE);
            const double p[3] = {at[i][0] * scales[s], at[i][1] * scales[s], at[i][2] * scales[s]};
            const double center[3] = {0}, radius = distances[i] * scales[s];
            assert_int_equal(octree_insert(tree, p, 1), OCTREE_OK);
            assert_int_equal(count_within(tree, center, radius), 1);
            assert_int_equal(count_within(tree, center, next_up(radius)), 1);
            assert_int_equal(count_within(tree, center, next_down(radius)), 0);
            assert_int_equal(within(tree, center, radius), OCTREE_OK);
            assert_int_equal(within(tree, center, next_up(radius)), OCTREE_OK);
            assert_int_equal(within(tree, center, next_down(radius)), OCTREE_NOT_FOUND);
            assert_int_equal(count_within(tree, p, 0), 1);
            octree_destroy(tree);
        }
}

static void a_radius_that_rounding_would_reach_is_not_reached(void **state)
{
    (void)state;
    /* The root of 2 lies between two doubles, that of 1 + 2^-106 between 1 and the next; rounded sums say otherwise. */
    octree *tree = make_tree(cube(-2, 2), 1, 21, OCTREE_REFUSE);
    const double zero[3] = {0};
    assert_int_equal(octree_insert(tree, (double[3]){1, 1, 0}, 1), OCTREE_OK);
    double below = 0x1.6a09e667f3bccp0;
    assert_int_equal(count_within(tree, zero, below), 0);
    assert_int_equal(within(tree, zero, below), OCTREE_NOT_FOUND);
    assert_int_equal(count_within(tree, zero, next_up(below)), 1);
    assert_int_equal(within(tree, zero, next_up(below)), OCTREE_OK);
    assert_int_equal(octree_remove(tree, (double[3]){1, 1, 0}, 1), OCTREE_OK);
    static const double slight[] = {0x1p-53, 1e-100, 1e-300, 5e-324};
    for (size_t i = 0; i < sizeof slight / sizeof slight[0]; i++) {
        const double at[3] = {-1, 0, slight[i]};
        assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
        assert_int_equal(count_within(tree, zero, 1), 0);
        assert_int_equal(within(tree, zero, 1), OCTREE_NOT_FOUND);
        assert_int_equal(count_within(tree, zero, next_up(1)), 1);
        assert_int_equal(octree_remove(tree, at, 1), OCTREE_OK);
    }
    octree_destroy(tree);
}

static void radius_zero_is_the_place_itself(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 2, 21, OCTREE_GROW);
    for (uint64_t id = 0; id < 7; id++)
        assert_int_equal(octree_insert(tree, (double[3]){0.0, -0.0, 0.5}, id), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){5e-324, 0, 0.5}, 7), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, next_up(0.5)}, 8), OCTREE_OK);
    static const double here[3] = {-0.0, 0, 0.5};
    octree_neighbor nearest;
    for (double radius = -0.0; radius <= 0x1p-1000; radius = radius == 0 ? 0x1p-1074 : radius * 0x1p30)
        assert_int_equal(count_within(tree, here, radius), radius == 0 ? 7 : 8);
    assert_int_equal(count_within(tree, (double[3]){0, 1e-200, 0.5}, 0), 0);
    const octree_search others = {.skip = OCTREE_SKIP_COINCIDENT};
    assert_int_equal(octree_nearest_within(tree, here, 0, &others, &nearest), OCTREE_NOT_FOUND);
    assert_int_equal(octree_nearest_within(tree, here, 5e-324, &others, &nearest), OCTREE_OK);
    assert_true(nearest.point.id == 7 && nearest.distance == 5e-324);
    octree_destroy(tree);
}

static void within_follows_the_skip_rule_and_a_ball_does_not(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 1, 21, OCTREE_GROW);
    insert_all(tree, (const double[][3]){{0, 0, 0}, {3, 0, 0}, {0, 5, 0}}, 3);
    const octree_search rules[] = {{.skip = OCTREE_SKIP_ID, .skip_id = 1}, {.skip = OCTREE_SKIP_COINCIDENT}};
    for (int i = 0; i < 2; i++) {
        octree_neighbor nearest;
        brute found = {0};
        assert_int_equal(octree_nearest_within(tree, (double[3]){0}, 3, &rules[i], &nearest), OCTREE_OK);
        assert_true(nearest.point.id == 2 && nearest.distance == 3);
        assert_int_equal(octree_nearest_within(tree, (double[3]){0}, next_down(3), &rules[i], &nearest),
                         OCTREE_NOT_FOUND);
        assert_int_equal(octree_radius(tree, (double[3]){0}, 3, &rules[i], brute_collect, &found), OCTREE_OK);
        assert_int_equal(found.count, 2);
        brute_free(&found);
    }
    octree_destroy(tree);
}

static void any_finite_radius_and_center_are_accepted(void **state)
{
    (void)state;
    static const double worlds[] = {1e-310, 1e-200, 1, 1e200, DBL_MAX};
    for (size_t w = 0; w < sizeof worlds / sizeof worlds[0]; w++) {
        octree *tree = make_tree(cube(-worlds[w], worlds[w]), 1, 21, OCTREE_GROW);
        double unit = worlds[w] / 4;
        for (int i = 0; i < 20; i++)
            assert_int_equal(octree_insert(tree, (double[3]){(i % 5 - 2) * unit, (i / 5 - 2) * unit, unit}, 1),
                             OCTREE_OK);
        assert_int_equal(count_within(tree, (double[3]){0}, DBL_MAX), 20);
        assert_int_equal(count_within(tree, (double[3]){0, 0, unit}, 5e-324), 1);
        assert_int_equal(count_within(tree, (double[3]){0, 0, unit}, unit), 5);
        assert_int_equal(count_within(tree, (double[3]){0, 0, unit}, next_down(unit)), 1);
        assert_int_equal(count_within(tree, (double[3]){0}, next_down(unit)), 0);
        assert_int_equal(within(tree, (double[3]){0}, unit), OCTREE_OK);
        assert_int_equal(within(tree, (double[3]){0}, next_down(unit)), OCTREE_NOT_FOUND);
        assert_int_equal(within(tree, (double[3]){0}, DBL_MAX), OCTREE_OK);
        /* The world's middle is 1.41 DBL_MAX away; the largest world has three points that are nearer. */
        assert_int_equal(count_within(tree, (double[3]){-DBL_MAX, 0, DBL_MAX}, DBL_MAX), w == 4 ? 3 : 0);
        octree_destroy(tree);
    }
}

static bool count_one(const octree_point *point, void *context)
{
    (void)point;
    ++*(size_t *)context;
    return true;
}

static void a_radius_and_an_epsilon_may_reach_beyond_doubles(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-DBL_MAX, DBL_MAX), 4, 21, OCTREE_REFUSE);
    const double far_off[3] = {-DBL_MAX, 0, 0}, center[3] = {DBL_MAX, 0, 0};
    assert_int_equal(octree_insert(tree, far_off, 1), OCTREE_OK);
    for (int mode = 0; mode < 2; mode++) {
        octree_search how = {.epsilon = 0x1p1023, .mode = (octree_mode)mode};
        size_t count = 0;
        assert_int_equal(octree_radius(tree, center, 0x1.8p1023, &how, count_one, &count), OCTREE_OK);
        assert_int_equal(count, 0); /* the point is 2 DBL_MAX away, and the reach is 1.25 DBL_MAX */
    }
    octree_destroy(tree);
}

static void the_center_may_lie_outside(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 1, 21, OCTREE_GROW);
    insert_all(tree, (const double[][3]){{8, 0, 0}, {-8, 0, 0}, {8, 8, 8}}, 3);
    static const struct {
        double center[3], radius;
        size_t count;
    } cases[] = {
        {{11, 4, 0}, 5, 1},
        {{11, 4, 0}, 0x1.3ffffffffffffp2, 0},
        {{11, 20, 12}, 13, 1},
        {{0x1p60, 0, 0}, 0x1p60, 2}, /* (8, 8, 8) is nearer by almost 8 */
        {{-0x1p60, 0, 0}, 0x1p60, 1},
        {{1e300, 0, 0}, 1e300, 2},
        {{1e300, 0, 0}, 0x1.7e43c8800759bp+996, 0}, /* the double before 1e300 */
        {{0, 1e300, 0}, 1e300, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        assert_int_equal(count_within(tree, cases[i].center, cases[i].radius), cases[i].count);
    octree_destroy(tree);
}

typedef struct countdown {
    size_t calls, stop_at;
} countdown;

static bool visit_until(const octree_point *point, void *context)
{
    (void)point;
    countdown *c = context;
    return ++c->calls < c->stop_at;
}

static void a_visitor_that_stops_is_not_called_again(void **state)
{
    (void)state;
    uint64_t random = 4;
    brute all = {0};
    brute_scatter(&all, &random, 90, 8, UINT64_MAX);
    for (size_t capacity = 1; capacity <= 90; capacity += 8) {
        octree *tree = brute_tree(&all, cube(-8, 8), capacity, 21);
        static const double radii[] = {10, 1000}; /* nodes that are cut, and nodes that are taken whole */
        for (int i = 0; i < 2; i++) {
            size_t total = count_within(tree, (double[3]){0}, radii[i]);
            for (size_t stop_at = 1; stop_at <= total + 1; stop_at++) {
                countdown c = {.stop_at = stop_at};
                assert_int_equal(octree_radius(tree, (double[3]){0}, radii[i], NULL, visit_until, &c), OCTREE_OK);
                assert_int_equal(c.calls, stop_at < total ? stop_at : total);
            }
        }
        octree_destroy(tree);
    }
    brute_free(&all);
}

static void a_ball_agrees_with_a_scan_for_every_depth_and_capacity(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 64; seed++) {
        uint64_t random = seed;
        brute all = {0};
        brute_scatter(&all, &random, 200, seed % 3 == 0 ? 5 : 30, 50);
        octree *tree = brute_tree(&all, cube(-32, 32), 1 + seed, seed < 21 ? seed : 21);
        for (int i = 0; i < 60; i++) {
            double center[3], squared = 0;
            for (int axis = 0; axis < 3; axis++) {
                center[axis] = (double)random_below(&random, 81) - 40;
                double gap = all.points[i].position[axis] - center[axis];
                squared += gap * gap;
            }
            double root = floor(sqrt(squared)); /* whole, so that the square is exact; often a point's distance */
            brute expected = {0};
            brute_radius(&all, center, root, &expected);
            assert_within(tree, center, root, &expected);
            brute_free(&expected);
        }
        brute_free(&all);
        octree_destroy(tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(radius_and_within_refuse_invalid_arguments),
        cmocka_unit_test(the_sphere_itself_is_within),
        cmocka_unit_test(a_radius_that_rounding_would_reach_is_not_reached),
        cmocka_unit_test(radius_zero_is_the_place_itself),
        cmocka_unit_test(within_follows_the_skip_rule_and_a_ball_does_not),
        cmocka_unit_test(any_finite_radius_and_center_are_accepted),
        cmocka_unit_test(a_radius_and_an_epsilon_may_reach_beyond_doubles),
        cmocka_unit_test(the_center_may_lie_outside),
        cmocka_unit_test(a_visitor_that_stops_is_not_called_again),
        cmocka_unit_test(a_ball_agrees_with_a_scan_for_every_depth_and_capacity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
