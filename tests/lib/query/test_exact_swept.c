/* SPDX-License-Identifier: MIT */
/* test_exact_swept.c - swept boxes against exact rationals: grazing, near misses, and every scale of doubles. */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "brute.h"
#include "exact_oracle.h"

/* A step, and the box that is carried along. */
typedef struct sweep {
    double from[3], to[3], size;
} sweep;

static void find_wrong(const brute *expected, const brute *found, const sweep *s)
{
    for (size_t i = 0; i < expected->count + found->count; i++) {
        const bool missed = i < expected->count;
        const octree_point *p = missed ? &expected->points[i] : &found->points[i - expected->count];
        if (!brute_contains(missed ? found : expected, p->position, p->id))
            fail_msg("(%a %a %a) to (%a %a %a) with %a %s (%a %a %a)", s->from[0], s->from[1], s->from[2], s->to[0],
                     s->to[1], s->to[2], s->size, missed ? "misses" : "should not touch", p->position[0],
                     p->position[1], p->position[2]);
    }
}

static void assert_swept_in(const octree *tree, const brute *all, const sweep *s)
{
    const sweep back = {{s->to[0], s->to[1], s->to[2]}, {s->from[0], s->from[1], s->from[2]}, s->size};
    brute expected = {0}, found = {0}, reversed = {0};
    for (size_t i = 0; i < all->count; i++)
        if (exact_touches(s->from, s->to, s->size, all->points[i].position, all->points[i].position, NULL))
            brute_collect(&all->points[i], &expected);
    assert_int_equal(octree_collide_swept(tree, s->from, s->to, s->size, NULL, NULL, brute_collect, &found), OCTREE_OK);
    assert_int_equal(octree_collide_swept(tree, s->to, s->from, s->size, NULL, NULL, brute_collect, &reversed),
                     OCTREE_OK);
    find_wrong(&expected, &found, s);
    find_wrong(&expected, &reversed, &back);
    assert_true(brute_equal(&expected, &found) && brute_equal(&expected, &reversed)); /* each once */
    brute_free(&expected);
    brute_free(&found);
    brute_free(&reversed);
}

/* The test fails unless exactly the truly touched points are visited, there and back. Frees the points. */
static void assert_swept(brute *all, const sweep *s)
{
    octree *tree = brute_tree(all, cube(-DBL_MAX, DBL_MAX), 1, 21);
    assert_swept_in(tree, all, s);
    octree_destroy(tree);
    brute_free(all);
}

static double nudged(double value, int steps)
{
    for (; steps > 0; steps--)
        value = next_up(value);
    for (; steps < 0; steps++)
        value = next_down(value);
    return fmin(fmax(value, -DBL_MAX), DBL_MAX);
}

/* A point and all those that are up to `reach` doubles away on each axis. */
static void add_around(brute *all, const double at[3], int reach)
{
    for (int x = -reach; x <= reach; x++)
        for (int y = -reach; y <= reach; y++)
            for (int z = -reach; z <= reach; z++) {
                const double p[3] = {nudged(at[0], x), nudged(at[1], y), nudged(at[2], z)};
                if (!brute_contains(all, p, 0))
                    brute_insert(all, p, 0);
            }
}

/* The edges of the hull of (0,0,0) to (12,12,12) with size 4, moved and scaled: a point on an edge where two axes meet
 * at one moment, and one on a corner where all three do. */
static void grazing_is_decided_to_the_last_bit_at_every_scale(void **state)
{
    (void)state;
    static const int scales[] = {-1074, -1071, -1022, -1000, -540, -53, 0, 40, 500, 1000, 1019};
    static const double edges[][3] = {{3, 11, 7},   {11, 3, 7},   {2, 10, 2}, {10, 2, 6},  {3, 3, 11}, {-4, 4, 0},
                                      {4, -4, -4},  {-4, -4, -4}, {-4, 4, 4}, {16, 8, 16}, {8, 16, 8}, {16, 16, 16},
                                      {16, 16, 12}, {7, -1, 3},   {0, 0, 8},  {6, 14, 14}};
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++)
        for (size_t j = 0; j < sizeof edges / sizeof edges[0]; j++) {
            brute all = {0};
            const double unit = ldexp(1, scales[i]);
            sweep s = {{0, 0, 0}, {12 * unit, 12 * unit, 12 * unit}, 4 * unit};
            const double at[3] = {edges[j][0] * unit, edges[j][1] * unit, edges[j][2] * unit};
            assert_true(exact_touches(s.from, s.to, s.size, at, at, NULL));
            add_around(&all, at, 1);
            assert_swept(&all, &s);
        }
}

/* A place on the hull of a random sweep, as rounding lets it be: two or three axes at the end of their moment t. */
static void point_on_hull(uint64_t *random, const sweep *s, double t, double at[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const double center = s->from[axis] * (1 - t) + s->to[axis] * t;
        const double sides[4] = {s->size, -s->size, s->size * octree_random_unit(random), 0};
        at[axis] = fmin(fmax(center + sides[random_below(random, 4)], -DBL_MAX), DBL_MAX);
    }
}

static void near_misses_in(const octree_box *places, double largest, size_t trials, uint64_t seed)
{
    uint64_t random = seed;
    for (size_t i = 0; i < trials; i++) {
        sweep s;
        for (int axis = 0; axis < 3; axis++) {
            s.from[axis] = random_between(&random, places->min[axis], places->max[axis]);
            const bool still = random_below(&random, 6) == 0;
            s.to[axis] = still ? s.from[axis] : random_between(&random, places->min[axis], places->max[axis]);
        }
        s.size = random_between(&random, 0, largest);
        brute all = {0};
        for (int j = 0; j < 2; j++) {
            double at[3];
            const double moments[4] = {0, 1, 0.5, octree_random_unit(&random)};
            point_on_hull(&random, &s, moments[random_below(&random, 4)], at);
            add_around(&all, at, 1);
        }
        assert_swept(&all, &s);
    }
}

static void near_misses_within_an_ulp_are_distinguished_from_hits(void **state)
{
    (void)state;
    const octree_box small = cube(-1, 1), far = cube(1e15, 1e15 + 8), slab = {{-1e9, -1, -1e-9}, {1e9, 1, 1e-9}};
    near_misses_in(&small, 0.5, 80, 1);
    near_misses_in(&far, 4, 40, 2);
    near_misses_in(&slab, 1, 40, 3);
    near_misses_in(&slab, 1e-9, 40, 4);
}

static void near_misses_of_extreme_scales_are_distinguished_from_hits(void **state)
{
    (void)state;
    const octree_box huge = cube(-DBL_MAX, DBL_MAX), half = cube(-DBL_MAX / 4, DBL_MAX / 4),
                     tiny = cube(-1e-318, 1e-318), normal = cube(-1e-300, 1e-300);
    const octree_box mixed = {{-DBL_MAX, -1, -1e-320}, {DBL_MAX, 1, 1e-320}};
    near_misses_in(&huge, DBL_MAX, 40, 5);
    near_misses_in(&huge, 1e300, 40, 6);
    near_misses_in(&half, DBL_MAX / 8, 40, 7);
    near_misses_in(&tiny, 1e-319, 40, 8);
    near_misses_in(&normal, 1e-305, 40, 9);
    near_misses_in(&mixed, 0.5, 40, 10);
    near_misses_in(&mixed, 1e308, 40, 11);
    near_misses_in(&mixed, 1e-321, 40, 12);
}

/* Steps so long that the moments of touching are subnormal themselves, and differ by less than one of them. */
static void moments_that_underflow_are_distinguished(void **state)
{
    (void)state;
    uint64_t random = 13;
    for (int i = 0; i < 300; i++) {
        sweep s;
        const int bits = 30 + (int)random_below(&random, 24); /* coordinates upon a grid that rounds in sums, or not */
        for (int axis = 0; axis < 3; axis++) {
            s.from[axis] = ldexp((double)random_below(&random, 1u << 20), -bits);
            s.to[axis] = random_below(&random, 2) == 0 ? 0x1p1023 : 0x1.8p1023;
        }
        s.size = 1 + ldexp((double)random_below(&random, 8), -52);
        brute all = {0};
        for (int j = 0; j < 4; j++) {
            const double near = 2 + ldexp((double)random_below(&random, 8), -51);
            const double at[3] = {near + s.from[0], near - 2 * s.size + s.from[1], s.from[2]};
            add_around(&all, at, 1);
        }
        assert_swept(&all, &s);
    }
}

static void any_mixture_of_extremes_is_decided_rightly(void **state)
{
    (void)state;
    uint64_t random = 14;
    for (int i = 0; i < 150; i++) {
        brute all = {0};
        for (int j = 0; j < 24; j++) {
            const double at[3] = {random_extreme(&random), random_extreme(&random), random_extreme(&random)};
            if (!brute_contains(&all, at, 0))
                brute_insert(&all, at, 0);
        }
        octree *tree = brute_tree(&all, cube(-DBL_MAX, DBL_MAX), 1, 21);
        for (int j = 0; j < 4; j++) {
            sweep s = {.size = fabs(random_extreme(&random))};
            for (int axis = 0; axis < 3; axis++) {
                s.from[axis] = random_extreme(&random);
                s.to[axis] = random_extreme(&random);
            }
            assert_swept_in(tree, &all, &s);
        }
        octree_destroy(tree);
        brute_free(&all);
    }
}

/* Whether the sweep finds just what a test at both ends does, of the points around the middle of a step along x. */
static bool ends_tell_all(const double from[3], const double to[3], double size)
{
    brute all = {0}, ends = {0}, swept = {0};
    add_around(&all, (const double[3]){from[0] + size, 0.25, 0.25}, 2);
    octree *tree = brute_tree(&all, cube(-8, 8), 4, 21);
    assert_int_equal(octree_collide_swept(tree, from, to, size, NULL, NULL, brute_collect, &swept), OCTREE_OK);
    for (size_t i = 0; i < all.count; i++) {
        brute one = {0};
        octree *alone = make_tree(cube(-8, 8), 1, 21, OCTREE_REFUSE);
        assert_int_equal(octree_insert(alone, all.points[i].position, 0), OCTREE_OK);
        assert_int_equal(octree_collide(alone, from, size, NULL, brute_collect, &one), OCTREE_OK);
        assert_int_equal(octree_collide(alone, to, size, NULL, brute_collect, &one), OCTREE_OK);
        if (one.count > 0)
            brute_collect(&all.points[i], &ends);
        octree_destroy(alone);
        brute_free(&one);
    }
    const bool all_told = brute_equal(&ends, &swept);
    octree_destroy(tree);
    brute_free(&all);
    brute_free(&ends);
    brute_free(&swept);
    return all_told;
}

static void the_two_ends_tell_all_of_a_step_of_at_most_two_boxes(void **state)
{
    (void)state;
    uint64_t random = 15;
    size_t short_steps = 0, gaps = 0;
    for (int i = 0; i < 400; i++) {
        const double size = random_between(&random, 0, 1);
        const double from[3] = {random_between(&random, -2, 2), 0.25, 0.25};
        const double to[3] = {nudged(from[0] + 2 * size, (int)random_below(&random, 5) - 2), 0.25, 0.25};
        const bool is_short = brute_is_within(from[0], 2 * size, to[0]); /* in real numbers: 2 * size does not round */
        const bool told = ends_tell_all(from, to, size);
        assert_true(told || !is_short);
        short_steps += is_short;
        gaps += !told;
    }
    assert_true(short_steps > 100 && gaps > 10); /* one ulp more than two boxes can leave a gap */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grazing_is_decided_to_the_last_bit_at_every_scale),
        cmocka_unit_test(near_misses_within_an_ulp_are_distinguished_from_hits),
        cmocka_unit_test(near_misses_of_extreme_scales_are_distinguished_from_hits),
        cmocka_unit_test(moments_that_underflow_are_distinguished),
        cmocka_unit_test(any_mixture_of_extremes_is_decided_rightly),
        cmocka_unit_test(the_two_ends_tell_all_of_a_step_of_at_most_two_boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
