/* SPDX-License-Identifier: MIT */
/* test_exact_epsilon.c - what epsilon and FAST promise, by whole-number arithmetic: ratios, lengths, and their edges.
 */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "brute.h"
#include "exact_oracle.h"

static double extent(const octree *tree)
{
    octree_def def = octree_definition(tree);
    double most = 0;
    for (int axis = 0; axis < 3; axis++)
        most = fmax(most, def.world.max[axis] / 2 - def.world.min[axis] / 2);
    return most; /* half of it, to be strict */
}

/* Whether a may stand for b: at most 1 + ratio times as far; in FAST mode also 2^-490 of the extent farther. */
static bool may_stand_for(const octree *tree, const double target[3], const double a[3], const double b[3],
                          octree_mode mode, double ratio)
{
    if (mode == OCTREE_EXACT)
        return exact_compare_ratio(target, a, b, ratio) <= 0;
    return exact_compare_ratio(target, a, b, ratio + 0x1p-50 * (1 + ratio)) <= 0 ||
           exact_compare_longer(target, a, b, extent(tree) * 0x1p-490) <= 0;
}

/* The test fails unless each of the k found stands rightly for the true one. */
static void assert_neighbors(const octree *tree, const brute *all, const double target[3], size_t k, octree_mode mode,
                             double ratio)
{
    octree_point *sorted = malloc((all->count + 1) * sizeof *sorted);
    octree_neighbor *found = malloc((all->count + 1) * sizeof *found);
    assert_true(sorted != NULL && found != NULL);
    size_t count, left = exact_nearest_sorted(all->points, all->count, target, OCTREE_SKIP_NONE, 0, sorted);
    const octree_search how = {.mode = mode, .epsilon = ratio};
    assert_int_equal(octree_nearest_k(tree, target, k, &how, found, &count), OCTREE_OK);
    assert_int_equal(count, k < left ? k : left);
    for (size_t i = 0; i < count; i++) {
        assert_true(brute_contains(all, found[i].point.position, found[i].point.id));
        if (!may_stand_for(tree, target, found[i].point.position, sorted[i].position, mode, ratio))
            fail_msg("number %zu to (%a %a %a) with epsilon %a is %a away, not %a", i, target[0], target[1], target[2],
                     ratio, found[i].distance, sorted[i].position[0]);
    }
    free(sorted);
    free(found);
}

/* B lies across a plane, as far from the target as its cell, and A with the target, ratio times as far and a few ulp
 * more or less: nearest octant first, A is found before B's cell is judged. */
static void adversarial_pair(double scale, double epsilon, octree_mode mode, uint64_t *random)
{
    double gap = ldexp(random_between(random, 0.5, 1), -(int)random_below(random, 40));
    double reach = gap * (1 + epsilon);
    if (reach > 1)
        return;
    for (uint64_t i = random_below(random, 9), down = random_below(random, 2); i > 0; i--)
        reach = down ? next_down(reach) : next_up(reach);
    const double y = random_between(random, 0, 1), z = random_between(random, 0, 1);
    double slant = random_below(random, 2) == 0 ? 0 : random_between(random, 0, 1.4);
    brute all = {0};
    const double target[3] = {-gap * scale, y * scale, z * scale};
    brute_insert(&all, (double[3]){(-gap - reach * cos(slant)) * scale, (y + reach * sin(slant)) * scale, z * scale},
                 1);
    brute_insert(&all, (double[3]){0, y * scale, z * scale}, 2);
    octree *tree = brute_tree(&all, cube(-4 * scale, 4 * scale), 1, 21);
    assert_neighbors(tree, &all, target, 1, mode, epsilon);
    assert_neighbors(tree, &all, target, 2, mode, epsilon);
    octree_destroy(tree);
    brute_free(&all);
}

static void pairs_at_the_edge_of_the_ratio_are_within_it(void **state)
{
    (void)state;
    static const double scales[] = {1, 1e-3, 1e200, 1e-200, 4e307, 1e-310};
    static const double epsilons[] = {0x1p-53, 0x1p-52, 0x1p-51, 0x1p-50, 1e-10, 0.001, 0.1,
                                      0.25,    1.0 / 3, 0.5,     1,       7,     1e6};
    uint64_t random = 1;
    for (size_t s = 0; s < sizeof scales / sizeof scales[0]; s++)
        for (size_t e = 0; e < sizeof epsilons / sizeof epsilons[0]; e++)
            for (int i = 0; i < 50; i++)
                adversarial_pair(scales[s], epsilons[e], (octree_mode)(i % 2), &random);
}

static void every_kind_of_cloud_is_within_the_ratio(void **state)
{
    (void)state;
    static const double epsilons[] = {0, 1e-12, 0.01, 0.3, 1, 10};
    static const double scales[] = {1, 1e200, 1e-200};
    uint64_t random = 2;
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++)
        for (int s = 0; s < 3; s++) {
            octree_box world = cube(-scales[s], scales[s]);
            brute all = {0};
            brute_sample(&all, (octree_sample_kind)kind, 9, &world, 200);
            octree *tree = brute_tree(&all, world, 1 + (size_t)kind, 21);
            for (size_t i = 0; i < 36; i++) {
                double target[3];
                for (int axis = 0; axis < 3; axis++)
                    target[axis] = random_between(&random, -1.2, 1.2) * scales[s];
                assert_neighbors(tree, &all, target, 1 + i % 9, (octree_mode)(i / 6 % 2), epsilons[i % 6]);
            }
            octree_destroy(tree);
            brute_free(&all);
        }
}

static void fast_is_within_its_bound_on_near_ties(void **state)
{
    (void)state;
    static const double scales[] = {1, 1e200, DBL_MAX, 1e-200, 1e-310, 5e-324 * 1000};
    uint64_t random = 3;
    for (int s = 0; s < 6; s++)
        for (int i = 0; i < 60; i++) {
            octree_box world = cube(-scales[s], scales[s]);
            brute all = {0};
            double target[3], offset[3];
            for (int axis = 0; axis < 3; axis++) {
                target[axis] = random_between(&random, -0.4, 0.4) * scales[s];
                offset[axis] = random_between(&random, 0, 0.5) * scales[s];
            }
            for (uint64_t id = 0; id < 12; id++) {
                double at[3];
                for (int axis = 0; axis < 3; axis++)
                    at[axis] = target[axis] + (random_below(&random, 2) == 0 ? offset[axis] : -offset[axis]);
                brute_insert(&all, at, id);
            }
            octree *tree = brute_tree(&all, world, 2, 21);
            assert_neighbors(tree, &all, target, 1 + (size_t)i % 12, OCTREE_FAST, 0);
            octree_destroy(tree);
            brute_free(&all);
        }
}

static void fast_is_within_its_bound_where_squares_vanish(void **state)
{
    (void)state;
    uint64_t random = 4;
    brute all = {0};
    for (uint64_t id = 0; id < 100; id++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = ldexp(random_between(&random, -1, 1), -(int)random_below(&random, 600));
        brute_insert(&all, at, id);
    }
    octree *tree = brute_tree(&all, cube(-1, 1), 1, 21);
    for (int i = 0; i < 100; i++) {
        double target[3];
        for (int axis = 0; axis < 3; axis++)
            target[axis] = ldexp(random_between(&random, -1, 1), -(int)random_below(&random, 600));
        assert_neighbors(tree, &all, target, 7, OCTREE_FAST, 0);
        assert_neighbors(tree, &all, (double[3]){0}, 1 + (size_t)i, OCTREE_FAST, 0);
    }
    octree_destroy(tree);
    brute_free(&all);
}

/* Whether a ball query must, or may, visit a point. */
static bool must_visit(const double c[3], const double p[3], double radius, double slack)
{
    return slack <= radius && exact_compare_radius(c, p, radius, -slack) <= 0;
}

static void assert_ball(const octree *tree, const brute *all, const double center[3], double radius,
                        const octree_search *how)
{
    brute found = {0};
    assert_int_equal(octree_radius(tree, center, radius, how, brute_collect, &found), OCTREE_OK);
    bool fast = how->mode == OCTREE_FAST;
    double slack = fast ? fmax((radius + how->epsilon) * 0x1p-50, extent(tree) * 0x1p-489) : 0;
    for (size_t i = 0; i < all->count; i++) {
        const octree_point *point = &all->points[i];
        bool visited = brute_contains(&found, point->position, point->id);
        if (must_visit(center, point->position, radius, slack) && !visited)
            fail_msg("(%a %a %a) is within %a", point->position[0], point->position[1], point->position[2], radius);
        double most = fast ? how->epsilon + slack : how->epsilon;
        if (visited && exact_compare_radius(center, point->position, radius, most) > 0)
            fail_msg("(%a %a %a) is beyond %a + %a", point->position[0], point->position[1], point->position[2], radius,
                     most);
    }
    brute_free(&found);
}

static void balls_miss_nothing_and_stay_within_epsilon(void **state)
{
    (void)state;
    static const double scales[] = {1, 1e200, 1e-200, 1e-310};
    uint64_t random = 5;
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++)
        for (int s = 0; s < 4; s++) {
            octree_box world = cube(-scales[s], scales[s]);
            brute all = {0};
            brute_sample(&all, (octree_sample_kind)kind, 4, &world, 150);
            octree *tree = brute_tree(&all, world, 2, 21);
            for (int i = 0; i < 60; i++) {
                double center[3];
                for (int axis = 0; axis < 3; axis++)
                    center[axis] = random_between(&random, -1.2, 1.2) * scales[s];
                octree_neighbor found[40];
                size_t count;
                assert_int_equal(octree_nearest_k(tree, center, 40, NULL, found, &count), OCTREE_OK);
                /* Both balls end at points, or a double from them. */
                double radius = found[random_below(&random, 20)].distance;
                double epsilon = found[20 + random_below(&random, 20)].distance - radius;
                epsilon = i % 4 == 0 ? 0 : i % 4 == 1 ? fmax(next_down(epsilon), 0) : epsilon;
                radius = i % 3 == 0 ? fmax(next_down(radius), 0) : radius;
                assert_ball(tree, &all, center, radius, &(octree_search){.epsilon = epsilon});
                assert_ball(tree, &all, center, radius, &(octree_search){.epsilon = epsilon, .mode = OCTREE_FAST});
            }
            octree_destroy(tree);
            brute_free(&all);
        }
}

static void a_ball_that_ends_at_a_corner_of_cells_takes_no_more(void **state)
{
    (void)state;
    /* A cell's farthest corner is its world's corner, where a point lies: a ball that is one double short must miss it,
     * with radius and epsilon sharing the length in any way. */
    uint64_t random = 6;
    for (int i = 0; i < 1500; i++) {
        double center[3], corner[3] = {1, 1, 1};
        for (int axis = 0; axis < 3; axis++)
            center[axis] = random_below(&random, 3) == 0 ? -1 : random_between(&random, -3, 1);
        brute all = {0};
        brute_insert(&all, corner, 1);
        brute_insert(&all, (double[3]){0, 0, 0}, 2);
        octree *tree = brute_tree(&all, cube(-1, 1), 1, 21);
        double length = 0;
        for (int axis = 0; axis < 3; axis++)
            length += (corner[axis] - center[axis]) * (corner[axis] - center[axis]);
        length = sqrt(length);
        length = i % 3 == 0 ? next_up(length) : i % 3 == 1 ? next_down(length) : length;
        double radius = length * random_between(&random, 0, 1);
        const octree_search how = {.epsilon = length - radius, .mode = (octree_mode)(i % 2)};
        assert_ball(tree, &all, center, radius, &how);
        octree_destroy(tree);
        brute_free(&all);
    }
}

static bool is_beyond(const octree_box *box, const double p[3], double epsilon)
{
    for (int axis = 0; axis < 3; axis++) {
        if (p[axis] < box->min[axis] && !exact_within(box->min[axis], epsilon, p[axis]))
            return true;
        if (p[axis] > box->max[axis] && !exact_within(box->max[axis], epsilon, p[axis]))
            return true;
    }
    return false;
}

static void assert_box(const octree *tree, const brute *all, const octree_box *box, double epsilon)
{
    brute found = {0};
    const octree_search how = {.epsilon = epsilon};
    assert_int_equal(octree_range_search(tree, box, &how, brute_collect, &found), OCTREE_OK);
    for (size_t i = 0; i < all->count; i++) {
        const octree_point *point = &all->points[i];
        bool visited = brute_contains(&found, point->position, point->id);
        assert_true(visited || !box_holds(box, point->position));
        if (visited && is_beyond(box, point->position, epsilon))
            fail_msg("(%a %a %a) is more than %a outside", point->position[0], point->position[1], point->position[2],
                     epsilon);
    }
    brute_free(&found);
}

static double nudged(double value, uint64_t *random)
{
    uint64_t nudge = random_below(random, 4);
    return nudge == 0 ? next_up(value) : nudge == 1 ? next_down(value) : value;
}

static void boxes_miss_nothing_and_stay_within_epsilon_at_every_plane(void **state)
{
    (void)state;
    static const octree_box worlds[] = {
        {{-1000, -1000, -1000}, {1000, 1000, 1000}},
        {{0.1, 0.1, 0.1}, {0.7, 1.3, 0.2}},
        {{-1e200, 1e15, 0}, {1e200, 1e15 + 8, 1e-310}},
        {{-DBL_MAX, -1, -DBL_MAX}, {DBL_MAX, 1, 0}},
    };
    uint64_t random = 7;
    for (size_t w = 0; w < sizeof worlds / sizeof worlds[0]; w++)
        for (int round = 0; round < 60; round++) {
            brute all = {0};
            octree_box corners = octree_cell_box(&worlds[w], (octree_address)8 + random_below(&random, 8));
            for (uint64_t id = 0; id < 40; id++) {
                double at[3];
                for (int axis = 0; axis < 3; axis++) {
                    double plane = random_below(&random, 2) == 0 ? corners.min[axis] : corners.max[axis];
                    at[axis] = fmin(fmax(nudged(plane, &random), worlds[w].min[axis]), worlds[w].max[axis]);
                }
                brute_insert(&all, at, id);
            }
            octree *tree = brute_tree(&all, worlds[w], 3, 21);
            for (int i = 0; i < 20; i++) {
                octree_box box;
                double epsilon = random_between(&random, 0, corners.max[round % 3] / 2 - corners.min[round % 3] / 2);
                for (int axis = 0; axis < 3; axis++) {
                    box.min[axis] = nudged(corners.min[axis] + (axis == i % 3 ? epsilon : 0), &random);
                    box.max[axis] = nudged(corners.max[axis] - (axis == i / 3 % 3 ? epsilon : 0), &random);
                    if (!(box.min[axis] <= box.max[axis]))
                        box.min[axis] = box.max[axis];
                }
                assert_box(tree, &all, &box, epsilon);
            }
            octree_destroy(tree);
            brute_free(&all);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_at_the_edge_of_the_ratio_are_within_it),
        cmocka_unit_test(every_kind_of_cloud_is_within_the_ratio),
        cmocka_unit_test(fast_is_within_its_bound_on_near_ties),
        cmocka_unit_test(fast_is_within_its_bound_where_squares_vanish),
        cmocka_unit_test(balls_miss_nothing_and_stay_within_epsilon),
        cmocka_unit_test(a_ball_that_ends_at_a_corner_of_cells_takes_no_more),
        cmocka_unit_test(boxes_miss_nothing_and_stay_within_epsilon_at_every_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
