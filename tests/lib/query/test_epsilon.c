/* SPDX-License-Identifier: MIT */
/* test_epsilon.c - epsilon for neighbours, boxes and balls, and FAST: within their bounds, and worth having.
 *
 * Whole coordinates and dyadic epsilons keep every square here exact; test_exact_epsilon.c has the rest.
 */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "brute.h"

static void random_target(uint64_t *random, double reach, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = (double)random_below(random, (uint64_t)(2 * reach) + 1) - reach;
}

/* Whether a is at most 1 + epsilon times as far from the target as b: exact for whole coordinates. */
static bool is_within_ratio(const double target[3], const octree_neighbor *a, const octree_neighbor *b, double epsilon)
{
    double to_a = 0, to_b = 0;
    for (int axis = 0; axis < 3; axis++) {
        double x = a->point.position[axis] - target[axis], y = b->point.position[axis] - target[axis];
        to_a += x * x;
        to_b += y * y;
    }
    return to_a <= (1 + epsilon) * (1 + epsilon) * to_b;
}

/* The test fails unless the i-th of k is at most 1 + epsilon times as far as the true i-th. Returns how many of them
 * are not the true distance. */
static size_t assert_ratio(const octree *tree, const brute *all, const double target[3], size_t k, double epsilon)
{
    octree_neighbor *expected;
    octree_neighbor found[32];
    size_t count = brute_nearest_k(all, target, k, OCTREE_SKIP_NONE, 0, &expected), found_count, farther = 0;
    const octree_search how = {.epsilon = epsilon};
    assert_int_equal(octree_nearest_k(tree, target, k, &how, found, &found_count), OCTREE_OK);
    assert_int_equal(found_count, count);
    for (size_t i = 0; i < count; i++) {
        assert_true(brute_contains(all, found[i].point.position, found[i].point.id));
        assert_true(found[i].distance >= expected[i].distance);
        assert_true(is_within_ratio(target, &found[i], &expected[i], epsilon));
        assert_true(i == 0 || found[i].distance >= found[i - 1].distance);
        farther += found[i].distance > expected[i].distance;
    }
    free(expected);
    return farther;
}

static void neighbors_are_within_their_ratio(void **state)
{
    (void)state;
    static const double epsilons[] = {0x1p-52, 0.125, 0.5, 1, 3, 15};
    size_t farther = 0;
    for (uint64_t seed = 0; seed < 24; seed++) {
        uint64_t random = seed;
        brute all = {0};
        brute_scatter(&all, &random, 200, 100, UINT64_MAX);
        octree *tree = brute_tree(&all, cube(-128, 128), 1 + seed % 5, 21);
        for (int i = 0; i < 60; i++) {
            double target[3];
            random_target(&random, 160, target);
            farther += assert_ratio(tree, &all, target, 1 + (size_t)i % 20, epsilons[i % 6]);
        }
        octree_destroy(tree);
        brute_free(&all);
    }
    assert_true(farther > 0); /* the knob is real */
}

/* Nearest octant first: A is found at distance `found` before the box of B, at distance 1, is met. True when B was
 * then still looked for. */
static bool looks_further(double found, double epsilon)
{
    octree *tree = make_tree(cube(-2048, 2048), 1, 21, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){-1 - found, 0, 0}, 1), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, 0}, 2), OCTREE_OK);
    octree_neighbor nearest;
    size_t count;
    const octree_search how = {.epsilon = epsilon};
    assert_int_equal(octree_nearest_k(tree, (double[3]){-1, 0, 0}, 1, &how, &nearest, &count), OCTREE_OK);
    octree_destroy(tree);
    return nearest.point.id == 2;
}

static void the_ratio_squared_is_what_prunes(void **state)
{
    (void)state;
    static const double epsilons[] = {0.5, 1, 3, 15, 255, 1023};
    for (size_t i = 0; i < sizeof epsilons / sizeof epsilons[0]; i++) {
        /* A may be this far away. If it is one part in 2^30 nearer, it may stand for B: distances of nodes are measured
         * in keys, with an error of about 2^-29 of the smallest cell. */
        double reach = 1 + epsilons[i];
        assert_true(looks_further(reach * (1 + 0x1p-40), epsilons[i]));
        assert_false(looks_further(reach * (1 - 0x1p-30), epsilons[i]));
    }
    assert_true(looks_further(1 + 0x1p-51, 0));
}

static void a_large_ratio_holds_between_tiny_distances(void **state)
{
    (void)state;
    /* B is g away, across the plane at 0, and A 1.3 (1 + epsilon) g: scaled squares of g are at the end of doubles. */
    static const double gaps[] = {0x1p-500, 0x1p-530, 0x1.6bp-536, 0x1.6bp-535, 0x1.01p-536, 0x1p-540, 0x1p-700};
    for (size_t i = 0; i < sizeof gaps / sizeof gaps[0]; i++)
        for (double ratio = 0x1p10; ratio <= 0x1p400; ratio *= 0x1p5) {
            octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_REFUSE);
            const double g = gaps[i], a = 1.3 * ratio * g;
            if (a < 0.5) {
                assert_int_equal(octree_insert(tree, (double[3]){-a - g, 0, 0}, 1), OCTREE_OK);
                assert_int_equal(octree_insert(tree, (double[3]){0, 0, 0}, 2), OCTREE_OK);
                octree_neighbor nearest;
                size_t count;
                const octree_search how = {.epsilon = ratio};
                assert_int_equal(octree_nearest_k(tree, (double[3]){-g, 0, 0}, 1, &how, &nearest, &count), OCTREE_OK);
                if (nearest.point.id != 2)
                    fail_msg("at %a, epsilon %a: the ratio is 1.3 (1 + epsilon)", g, ratio);
            }
            octree_destroy(tree);
        }
}

static void any_finite_ratio_is_accepted(void **state)
{
    (void)state;
    static const double epsilons[] = {5e-324, 1e-300, 1e100, 1e154, 1e200, DBL_MAX};
    uint64_t random = 5;
    brute all = {0};
    brute_scatter(&all, &random, 100, 10, UINT64_MAX);
    octree *tree = brute_tree(&all, cube(-16, 16), 2, 21);
    for (size_t i = 0; i < sizeof epsilons / sizeof epsilons[0]; i++)
        for (int mode = 0; mode < 2; mode++)
            for (size_t k = 1; k <= 128; k *= 2) {
                octree_neighbor found[128];
                size_t count;
                const octree_search how = {.epsilon = epsilons[i], .mode = (octree_mode)mode};
                assert_int_equal(octree_nearest_k(tree, (double[3]){0.5, 0, 0}, k, &how, found, &count), OCTREE_OK);
                assert_int_equal(count, k < all.count ? k : all.count);
                /* A point at the target is found whatever the ratio: (1 + epsilon) * 0 is 0. */
                assert_int_equal(octree_nearest_k(tree, all.points[k % 100].position, k, &how, found, &count),
                                 OCTREE_OK);
                assert_true(found[0].distance == 0);
            }
    octree_destroy(tree);
    brute_free(&all);
}

static void an_epsilon_does_not_lose_what_is_within_a_radius(void **state)
{
    (void)state;
    for (int mode = 0; mode < 2; mode++)
        for (double at = 0.5; at <= 7; at += 0.5) {
            octree *tree = make_tree(cube(-8, 8), 1, 21, OCTREE_REFUSE);
            assert_int_equal(octree_insert(tree, (double[3]){at, 0, 0}, 1), OCTREE_OK);
            assert_int_equal(octree_insert(tree, (double[3]){-7.5, -7.5, -7.5}, 2), OCTREE_OK);
            octree_neighbor nearest;
            const octree_search how = {.epsilon = 1, .mode = (octree_mode)mode};
            const double target[3] = {-1, 0, 0};
            assert_int_equal(octree_nearest_within(tree, target, at + 1, &how, &nearest), OCTREE_OK);
            assert_int_equal(nearest.point.id, 1);
            assert_int_equal(octree_nearest_within(tree, target, next_down(at + 1) - 0x1p-30, &how, &nearest),
                             OCTREE_NOT_FOUND);
            octree_destroy(tree);
        }
}

static void the_nearest_within_a_radius_is_within_its_ratio(void **state)
{
    (void)state;
    uint64_t random = 6;
    brute all = {0};
    brute_scatter(&all, &random, 300, 60, UINT64_MAX);
    octree *tree = brute_tree(&all, cube(-64, 64), 3, 21);
    for (int i = 0; i < 1000; i++) {
        double target[3], radius = (double)random_below(&random, 40), epsilon = (double)random_below(&random, 9) / 4;
        random_target(&random, 80, target);
        octree_neighbor truth, nearest;
        assert_true(brute_nearest(&all, target, OCTREE_SKIP_NONE, 0, &truth));
        const octree_search how = {.epsilon = epsilon};
        octree_status status = octree_nearest_within(tree, target, radius, &how, &nearest);
        assert_int_equal(status, truth.distance <= radius ? OCTREE_OK : OCTREE_NOT_FOUND);
        if (status == OCTREE_OK)
            assert_true(nearest.distance <= radius && is_within_ratio(target, &nearest, &truth, epsilon));
    }
    octree_destroy(tree);
    brute_free(&all);
}

static octree_box grown(octree_box box, double epsilon)
{
    for (int axis = 0; axis < 3; axis++) {
        box.min[axis] -= epsilon;
        box.max[axis] += epsilon;
    }
    return box;
}

/* The test fails unless inner is part of found and found of outer, each point once. Frees all three. */
static void assert_between(brute *inner, brute *found, brute *outer)
{
    assert_true(inner->count <= found->count && found->count <= outer->count);
    for (size_t i = 0; i < inner->count; i++)
        assert_true(brute_contains(found, inner->points[i].position, inner->points[i].id));
    for (size_t i = 0; i < found->count; i++) {
        assert_true(brute_contains(outer, found->points[i].position, found->points[i].id));
        for (size_t j = 0; j < i; j++)
            assert_false(found->points[i].id == found->points[j].id);
    }
    brute_free(inner);
    brute_free(found);
    brute_free(outer);
}

static void ranges_miss_nothing_and_stay_within_epsilon(void **state)
{
    (void)state;
    size_t more = 0;
    for (uint64_t seed = 0; seed < 20; seed++) {
        uint64_t random = seed;
        brute all = {0};
        brute_scatter(&all, &random, 150, 30, UINT64_MAX);
        octree *tree = brute_tree(&all, cube(-32, 32), 1 + seed % 9, seed + 2);
        for (int i = 0; i < 60; i++) {
            double center[3], radius = (double)random_below(&random, 24),
                              epsilon = (double)random_below(&random, 60) / 4;
            random_target(&random, 40, center);
            const octree_search how = {.epsilon = epsilon, .mode = (octree_mode)(i % 2)};
            octree_box box = {{center[0], center[1], center[2]}, {center[0], center[1], center[2]}};
            box = grown(box, radius);
            octree_box outer_box = grown(box, epsilon);
            brute inner = {0}, found = {0}, outer = {0};
            assert_int_equal(octree_range_search(tree, &box, &how, brute_collect, &found), OCTREE_OK);
            brute_range(&all, &box, &inner);
            brute_range(&all, &outer_box, &outer);
            more += found.count - inner.count;
            assert_between(&inner, &found, &outer);
            assert_int_equal(octree_radius(tree, center, radius, &how, brute_collect, &found), OCTREE_OK);
            brute_radius(&all, center, radius, &inner);
            brute_radius(&all, center, radius + epsilon, &outer);
            more += found.count - inner.count;
            assert_between(&inner, &found, &outer);
        }
        octree_destroy(tree);
        brute_free(&all);
    }
    assert_true(more > 0); /* the knob is real */
}

static void collisions_miss_nothing_and_stay_within_epsilon_and_on_the_way_are_exact(void **state)
{
    (void)state;
    size_t more = 0;
    uint64_t random = 3;
    brute all = {0};
    brute_scatter(&all, &random, 300, 30, UINT64_MAX);
    octree *tree = brute_tree(&all, cube(-32, 32), 3, 21);
    for (int i = 0; i < 300; i++) {
        double from[3], to[3], size = (double)random_below(&random, 12),
                               epsilon = (double)random_below(&random, 60) / 4;
        random_target(&random, 30, from);
        random_target(&random, 30, to);
        const octree_search how = {.epsilon = epsilon, .mode = (octree_mode)(i % 2)};
        brute inner = {0}, found = {0}, outer = {0};
        assert_int_equal(octree_collide_search(tree, from, size, NULL, &how, brute_collect, &found), OCTREE_OK);
        brute_collide(&all, from, size, NULL, &inner);
        brute_collide(&all, from, size + epsilon, NULL, &outer);
        more += found.count - inner.count;
        assert_between(&inner, &found, &outer);
        assert_int_equal(octree_collide_swept(tree, from, to, size, NULL, &how, brute_collect, &found), OCTREE_OK);
        for (size_t j = 0; j < all.count; j++)
            if (brute_touches(from, to, size, all.points[j].position, all.points[j].position))
                brute_collect(&all.points[j], &inner);
        assert_true(brute_equal(&inner, &found));
        brute_free(&inner);
        brute_free(&found);
    }
    assert_true(more > 0);
    static const octree_search bad = {.epsilon = -1};
    const double at[3] = {0};
    brute found = {0};
    assert_int_equal(octree_collide_search(tree, at, 1, NULL, &bad, brute_collect, &found), OCTREE_BAD_SIZE);
    assert_int_equal(octree_collide_swept(tree, at, at, 1, NULL, &bad, brute_collect, &found), OCTREE_BAD_SIZE);
    octree_destroy(tree);
    brute_free(&all);
}

static void epsilon_zero_is_exact(void **state)
{
    (void)state;
    uint64_t random = 11;
    brute all = {0};
    brute_scatter(&all, &random, 300, 20, UINT64_MAX);
    octree *tree = brute_tree(&all, cube(-32, 32), 3, 21);
    for (int i = 0; i < 100; i++) {
        static const octree_search zero = {.epsilon = 0};
        double target[3];
        random_target(&random, 40, target);
        assert_int_equal(assert_ratio(tree, &all, target, 12, 0), 0);
        octree_box box = grown((octree_box){{target[0], target[1], target[2]}, {target[0], target[1], target[2]}}, 9);
        brute plain = {0}, searched = {0};
        assert_int_equal(octree_range(tree, &box, brute_collect, &plain), OCTREE_OK);
        assert_int_equal(octree_range_search(tree, &box, &zero, brute_collect, &searched), OCTREE_OK);
        assert_true(brute_equal(&plain, &searched));
        brute_free(&plain);
        brute_free(&searched);
    }
    octree_destroy(tree);
    brute_free(&all);
}

static void epsilon_takes_any_box_and_length(void **state)
{
    (void)state;
    static const double epsilons[] = {0, 5e-324, 1e-200, 1, 1e200, DBL_MAX};
    static const octree_box boxes[] = {
        {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}},
        {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}},
        {{-INFINITY, -1, -DBL_MAX}, {0, INFINITY, DBL_MAX}},
    };
    uint64_t random = 2;
    brute all = {0};
    brute_scatter(&all, &random, 50, 3, UINT64_MAX);
    octree *tree = brute_tree(&all, cube(-DBL_MAX, DBL_MAX), 1, 21);
    for (size_t e = 0; e < sizeof epsilons / sizeof epsilons[0]; e++)
        for (size_t b = 0; b < 3; b++) {
            const octree_search how = {.epsilon = epsilons[e]};
            brute inner = {0}, found = {0};
            assert_int_equal(octree_range_search(tree, &boxes[b], &how, brute_collect, &found), OCTREE_OK);
            brute_range(&all, &boxes[b], &inner);
            assert_true(found.count >= inner.count && (epsilons[e] > 0 || found.count == inner.count));
            brute_free(&inner);
            brute_free(&found);
        }
    octree_destroy(tree);
    brute_free(&all);
}

/* What 300 questions cost on a cloud of clusters. */
typedef struct costs {
    octree_cost range, radius, nearest;
} costs;

static costs cost_of_questions(const octree *tree, double length, double ratio)
{
    costs c = {.range = {0}};
    uint64_t random = 7;
    for (int i = 0; i < 300; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = random_between(&random, -1, 1);
        octree_box box = grown((octree_box){{at[0], at[1], at[2]}, {at[0], at[1], at[2]}}, 0.3);
        octree_neighbor found[8];
        size_t count;
        brute ignored = {0};
        octree_search how = {.epsilon = length, .cost = &c.range};
        assert_int_equal(octree_range_search(tree, &box, &how, brute_collect, &ignored), OCTREE_OK);
        how.cost = &c.radius;
        assert_int_equal(octree_radius(tree, at, 0.3, &how, brute_collect, &ignored), OCTREE_OK);
        how = (octree_search){.epsilon = ratio, .cost = &c.nearest};
        assert_int_equal(octree_nearest_k(tree, at, 8, &how, found, &count), OCTREE_OK);
        brute_free(&ignored);
    }
    return c;
}

static void epsilon_saves_work_on_clusters(void **state)
{
    (void)state;
    octree_box world = cube(-1, 1);
    brute all = {0};
    brute_sample(&all, OCTREE_SAMPLE_CLUSTERED, 1, &world, 5000);
    octree *tree = brute_tree(&all, world, 8, 21);
    costs exact = cost_of_questions(tree, 0, 0), near = cost_of_questions(tree, 0.1, 0.5);
    assert_true(near.range.points * 10 < exact.range.points * 9);
    assert_true(near.radius.points * 10 < exact.radius.points * 9);
    assert_true(near.nearest.points * 10 < exact.nearest.points * 9);
    assert_true(near.nearest.nodes < exact.nearest.nodes);
    octree_destroy(tree);
    brute_free(&all);
}

static void fast_is_exact_where_squares_are(void **state)
{
    (void)state;
    static const octree_search fast = {.mode = OCTREE_FAST};
    uint64_t random = 21;
    brute all = {0};
    brute_scatter(&all, &random, 300, 20, 50);
    octree *tree = brute_tree(&all, cube(-32, 32), 4, 21);
    for (int i = 0; i < 200; i++) {
        double target[3], radius = (double)random_below(&random, 30);
        random_target(&random, 40, target);
        octree_neighbor *expected, found[16];
        size_t count = brute_nearest_k(&all, target, 16, OCTREE_SKIP_NONE, 0, &expected), found_count;
        assert_int_equal(octree_nearest_k(tree, target, 16, &fast, found, &found_count), OCTREE_OK);
        assert_int_equal(found_count, count);
        for (size_t j = 0; j < count; j++)
            assert_true(found[j].point.id == expected[j].point.id && found[j].distance == expected[j].distance);
        free(expected);
        brute ball = {0}, scan = {0};
        assert_int_equal(octree_radius(tree, target, radius, &fast, brute_collect, &ball), OCTREE_OK);
        brute_radius(&all, target, radius, &scan);
        assert_true(brute_equal(&ball, &scan));
        brute_free(&ball);
        brute_free(&scan);
    }
    octree_destroy(tree);
    brute_free(&all);
}

/* Of these squares none can be told from 0, with an array and with a heap of neighbours. */
static void fast_reports_the_distances_of_points_whose_squares_vanish(void **state)
{
    (void)state;
    enum { COUNT = 40 };
    static const octree_search fast = {.mode = OCTREE_FAST};
    octree *tree = make_tree(cube(-1, 1), 64, 21, OCTREE_GROW);
    octree_neighbor found[COUNT];
    for (uint64_t id = 0; id < COUNT; id++)
        assert_int_equal(octree_insert(tree, (double[3]){(double)(id * 7 % COUNT + 1) * 1e-162, 0, 0}, id), OCTREE_OK);
    for (size_t k = 3; k <= COUNT; k += COUNT - 3) {
        size_t count;
        assert_int_equal(octree_nearest_k(tree, (double[3]){0}, k, &fast, found, &count), OCTREE_OK);
        assert_int_equal(count, k);
        for (size_t i = 0; i < count; i++) {
            assert_true(found[i].distance == found[i].point.position[0]);
            assert_true(i == 0 || found[i].distance > found[i - 1].distance);
        }
    }
    octree_destroy(tree);
}

static void fast_excludes_points_far_outside_a_radius(void **state)
{
    (void)state;
    static const octree_search fast = {.mode = OCTREE_FAST};
    static const double far[] = {1e100, 0x1p500, 1e155, 1e200, 1e300};
    octree *tree = make_tree(cube(-1000, 1000), 1, 21, OCTREE_REFUSE);
    insert_all(tree, (const double[][3]){{1, 2, 3}, {-500, 20, 30}}, 2);
    for (size_t i = 0; i < sizeof far / sizeof far[0]; i++) {
        const double center[3] = {far[i], 0, 0};
        brute found = {0};
        octree_neighbor nearest;
        assert_int_equal(octree_radius(tree, center, far[i] / 10, &fast, brute_collect, &found), OCTREE_OK);
        assert_int_equal(found.count, 0);
        assert_int_equal(octree_nearest_within(tree, center, far[i] / 10, &fast, &nearest), OCTREE_NOT_FOUND);
        assert_int_equal(octree_radius(tree, center, far[i] * 2, &fast, brute_collect, &found), OCTREE_OK);
        assert_int_equal(found.count, 2);
        assert_int_equal(octree_nearest_within(tree, center, far[i] * 2, &fast, &nearest), OCTREE_OK);
        brute_free(&found);
    }
    octree_destroy(tree);
}

/* A mirrored pair, equally far but for an ulp here and there, whose lower id is on either side. */
static bool fast_differs(uint64_t *random)
{
    octree *tree = make_tree(cube(-2, 2), 2, 21, OCTREE_REFUSE);
    double target[3], at[2][3];
    for (int axis = 0; axis < 3; axis++) {
        double offset = random_between(random, 0, 1);
        target[axis] = random_between(random, -1, 1);
        at[0][axis] = target[axis] + offset;
        at[1][axis] = target[axis] - offset;
    }
    insert_all(tree, (const double(*)[3])at, 2);
    octree_neighbor exact, fast;
    size_t count;
    assert_int_equal(octree_nearest_k(tree, target, 1, NULL, &exact, &count), OCTREE_OK);
    assert_int_equal(octree_nearest_k(tree, target, 1, &(octree_search){.mode = OCTREE_FAST}, &fast, &count),
                     OCTREE_OK);
    octree_destroy(tree);
    return exact.point.id != fast.point.id;
}

static void fast_differs_on_some_near_ties(void **state)
{
    (void)state;
    uint64_t random = 1;
    int differ = 0;
    for (int i = 0; i < 1000; i++)
        differ += fast_differs(&random);
    assert_true(differ > 0 && differ < 500);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbors_are_within_their_ratio),
        cmocka_unit_test(the_ratio_squared_is_what_prunes),
        cmocka_unit_test(a_large_ratio_holds_between_tiny_distances),
        cmocka_unit_test(any_finite_ratio_is_accepted),
        cmocka_unit_test(an_epsilon_does_not_lose_what_is_within_a_radius),
        cmocka_unit_test(the_nearest_within_a_radius_is_within_its_ratio),
        cmocka_unit_test(ranges_miss_nothing_and_stay_within_epsilon),
        cmocka_unit_test(collisions_miss_nothing_and_stay_within_epsilon_and_on_the_way_are_exact),
        cmocka_unit_test(epsilon_zero_is_exact),
        cmocka_unit_test(epsilon_takes_any_box_and_length),
        cmocka_unit_test(epsilon_saves_work_on_clusters),
        cmocka_unit_test(fast_is_exact_where_squares_are),
        cmocka_unit_test(fast_reports_the_distances_of_points_whose_squares_vanish),
        cmocka_unit_test(fast_excludes_points_far_outside_a_radius),
        cmocka_unit_test(fast_differs_on_some_near_ties),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
