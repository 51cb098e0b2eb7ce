/* SPDX-License-Identifier: MIT */
/* test_swept.c - collision on the way: walls are never tunnelled, whatever the step. test_exact_swept.c has the truth
 * about grazing and extreme scales.
 */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "brute.h"

static void sweep_into(const octree *tree, const double from[3], const double to[3], double size, brute *found)
{
    assert_int_equal(octree_collide_swept(tree, from, to, size, NULL, NULL, brute_collect, found), OCTREE_OK);
}

static size_t hits(const octree *tree, const double from[3], const double to[3], double size, const octree_point *self)
{
    brute found = {0};
    assert_int_equal(octree_collide_swept(tree, from, to, size, self, NULL, brute_collect, &found), OCTREE_OK);
    size_t count = found.count;
    brute_free(&found);
    return count;
}

/* Whether a tree that holds nothing but `at` says that it is touched. */
static bool touches(const double at[3], const double from[3], const double to[3], double size)
{
    octree *tree = make_tree(cube(-DBL_MAX, DBL_MAX), 1, 21, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
    size_t count = hits(tree, from, to, size, NULL);
    octree_destroy(tree);
    return count == 1;
}

/* The pairs of a collision test at both ends, each once. */
static void collide_at_both_ends(const octree *tree, const double from[3], const double to[3], double size, brute *ends)
{
    brute last = {0};
    assert_int_equal(octree_collide(tree, from, size, NULL, brute_collect, ends), OCTREE_OK);
    assert_int_equal(octree_collide(tree, to, size, NULL, brute_collect, &last), OCTREE_OK);
    for (size_t i = 0; i < last.count; i++)
        if (!brute_contains(ends, last.points[i].position, last.points[i].id))
            brute_collect(&last.points[i], ends);
    brute_free(&last);
}

static void swept_refuses_null(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    const double at[3] = {0, 0, 0};
    assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
    brute found = {0};
    assert_int_equal(octree_collide_swept(NULL, at, at, 1, NULL, NULL, brute_collect, &found), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_collide_swept(tree, NULL, at, 1, NULL, NULL, brute_collect, &found), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_collide_swept(tree, at, NULL, 1, NULL, NULL, brute_collect, &found), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_collide_swept(tree, at, at, 1, NULL, NULL, NULL, &found), OCTREE_NULL_ARGUMENT);
    assert_int_equal(found.count, 0);
    octree_destroy(tree);
}

static void swept_refuses_bad_sizes_and_places(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    const double at[3] = {0, 0, 0};
    assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
    brute found = {0};
    static const struct {
        double size;
        octree_status status;
    } sizes[] = {{-1, OCTREE_BAD_SIZE},
                 {-5e-324, OCTREE_BAD_SIZE},
                 {NAN, OCTREE_NOT_FINITE},
                 {INFINITY, OCTREE_NOT_FINITE},
                 {-INFINITY, OCTREE_NOT_FINITE}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        assert_int_equal(octree_collide_swept(tree, at, at, sizes[i].size, NULL, NULL, brute_collect, &found),
                         sizes[i].status);
    static const double values[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 9; i++) {
        double bad[3] = {0, 0, 0};
        bad[i % 3] = values[i / 3];
        assert_int_equal(octree_collide_swept(tree, bad, at, 1, NULL, NULL, brute_collect, &found), OCTREE_NOT_FINITE);
        assert_int_equal(octree_collide_swept(tree, at, bad, 1, NULL, NULL, brute_collect, &found), OCTREE_NOT_FINITE);
    }
    assert_int_equal(found.count, 0);
    assert_int_equal(hits(tree, at, at, -0.0, NULL), 1);
    octree_destroy(tree);
}

static void a_diagonal_step_meets_the_point_that_both_ends_miss(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1000, 1000), 2, 5, OCTREE_REFUSE);
    const double from[3] = {0, 0, 0}, to[3] = {60, 60, 0};
    assert_int_equal(octree_insert(tree, (double[3]){45, 15, 0}, 1), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){61, 0, 0}, 2), OCTREE_OK); /* in the box around it, not in it */
    brute ends = {0};
    collide_at_both_ends(tree, from, to, 30, &ends);
    assert_int_equal(ends.count, 0);
    brute_free(&ends);
    brute found = {0};
    sweep_into(tree, from, to, 30, &found);
    assert_int_equal(found.count, 1);
    assert_int_equal(found.points[0].id, 1);
    brute_free(&found);
    octree_destroy(tree);
}

/* A wall of points through the origin: rows along `u` and `v`, which are whole numbers, `spacing` apart. */
static octree *build_wall(const int u[3], const int v[3], double spacing)
{
    octree *tree = make_tree(cube(-4000, 4000), 2, 8, OCTREE_GROW);
    uint64_t id = 0;
    for (int i = -16; i <= 16; i++)
        for (int j = -16; j <= 16; j++) {
            const double at[3] = {spacing * (i * u[0] + j * v[0]), spacing * (i * u[1] + j * v[1]),
                                  spacing * (i * u[2] + j * v[2])};
            assert_int_equal(octree_insert(tree, at, id++), OCTREE_OK);
        }
    return tree;
}

/* Steps through the wall x = 0 of whatever length, at a slant: both ends are beside the wall, on its two sides. */
static void rows_two_boxes_apart_stop_every_step(void **state)
{
    (void)state;
    static const double lengths[] = {5e-324, 1e-300, 1e-9, 1, 30, 60, 61, 500, 4000, 1e9, 1e200, DBL_MAX};
    static const int along[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    uint64_t random = 1;
    for (int axis = 0; axis < 3; axis++) {
        octree *tree = build_wall(along[(axis + 1) % 3], along[(axis + 2) % 3], 60);
        for (int i = 0; i < 300; i++) {
            double from[3], to[3];
            for (int other = 0; other < 3; other++) {
                from[other] = random_between(&random, -960, 960);
                to[other] = random_between(&random, -960, 960);
            }
            from[axis] = -lengths[random_below(&random, 12)];
            to[axis] = lengths[random_below(&random, 12)];
            const bool back = random_below(&random, 2) == 0;
            if (hits(tree, back ? to : from, back ? from : to, 30, NULL) == 0)
                fail_msg("(%a %a %a) to (%a %a %a) tunnels the wall on axis %d", from[0], from[1], from[2], to[0],
                         to[1], to[2], axis);
        }
        octree_destroy(tree);
    }
}

/* The wall x + y = 0. A step of (a, b, c) from a place on one side to one on the other crosses it within its rows. */
static void a_slanted_wall_stops_every_step(void **state)
{
    (void)state;
    octree *tree = build_wall((const int[3]){1, -1, 0}, (const int[3]){0, 0, 1}, 60);
    uint64_t random = 2;
    for (int i = 0; i < 1500; i++) {
        double from[3], to[3];
        for (int axis = 0; axis < 3; axis++) {
            from[axis] = random_between(&random, -960, 960);
            to[axis] = random_between(&random, -960, 960);
        }
        if ((from[0] > -from[1]) == (to[0] > -to[1]))
            continue;
        assert_true(hits(tree, from, to, 30, NULL) > 0);
    }
    octree_destroy(tree);
}

static void a_box_of_no_size_meets_the_points_on_its_line_and_no_others(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-100, 100), 1, 21, OCTREE_GROW);
    const double from[3] = {-9, -18, 27}, to[3] = {9, 18, -27};
    for (int i = -12; i <= 12; i++) {
        assert_int_equal(octree_insert(tree, (double[3]){i, 2 * i, -3 * i}, 1), OCTREE_OK);
        assert_int_equal(octree_insert(tree, (double[3]){i, next_up(2 * i), -3 * i}, 2), OCTREE_OK);
    }
    brute found = {0};
    sweep_into(tree, from, to, 0, &found);
    assert_int_equal(found.count, 19);
    for (size_t i = 0; i < found.count; i++)
        assert_int_equal(found.points[i].id, 1);
    brute_free(&found);
    octree_destroy(tree);
}

static void a_step_of_no_length_is_a_collision_test(void **state)
{
    (void)state;
    uint64_t random = 3;
    brute all = {0};
    const octree_box world = cube(-2, 2);
    brute_sample(&all, OCTREE_SAMPLE_CLUSTERED, 3, &world, 600);
    octree *tree = brute_tree(&all, world, 3, 10);
    for (int i = 0; i < 600; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = random_between(&random, -2.5, 2.5);
        const octree_point *near = &all.points[random_below(&random, all.count)];
        const double size = fabs(near->position[i % 3] - at[i % 3]); /* puts it on a face, or an ulp beside */
        brute found = {0}, expected = {0};
        sweep_into(tree, at, at, size, &found);
        assert_int_equal(octree_collide(tree, at, size, NULL, brute_collect, &expected), OCTREE_OK);
        assert_true(brute_equal(&found, &expected));
        brute_free(&expected);
        brute_collide(&all, at, size, NULL, &expected);
        assert_true(brute_equal(&found, &expected));
        brute_free(&found);
        brute_free(&expected);
    }
    octree_destroy(tree);
    brute_free(&all);
}

static void steps_of_two_boxes_along_one_axis_need_no_sweep(void **state)
{
    (void)state;
    uint64_t random = 4;
    brute all = {0};
    brute_scatter(&all, &random, 1500, 30, 5);
    octree *tree = brute_tree(&all, cube(-30, 30), 2, 21);
    for (int i = 0; i < 300; i++) {
        const double size = (double)random_below(&random, 12);
        double from[3];
        for (int axis = 0; axis < 3; axis++)
            from[axis] = (double)random_below(&random, 70) - 35;
        double to[3] = {from[0], from[1], from[2]};
        to[i % 3] += (double)random_below(&random, (uint64_t)(4 * size) + 1) - 2 * size;
        brute ends = {0}, found = {0};
        collide_at_both_ends(tree, from, to, size, &ends);
        sweep_into(tree, from, to, size, &found);
        assert_true(brute_equal(&ends, &found));
        brute_free(&ends);
        brute_free(&found);
    }
    octree_destroy(tree);
    brute_free(&all);
}

static void one_ulp_more_than_two_boxes_leaves_a_gap_that_the_sweep_closes(void **state)
{
    (void)state;
    for (int axis = 0; axis < 3; axis++) {
        double at[3] = {0, 0, 0}, from[3] = {0, 0, 0}, to[3] = {0, 0, 0};
        at[axis] = next_up(30);
        octree *tree = make_tree(cube(-1000, 1000), 1, 21, OCTREE_REFUSE);
        assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
        for (int more = 0; more < 2; more++) {
            to[axis] = more == 0 ? 60 : next_up(60);
            brute ends = {0};
            collide_at_both_ends(tree, from, to, 30, &ends);
            assert_int_equal(ends.count, 1 - more);
            assert_int_equal(hits(tree, from, to, 30, NULL), 1);
            assert_int_equal(hits(tree, to, from, 30, NULL), 1);
            brute_free(&ends);
        }
        octree_destroy(tree);
    }
}

/* A whole step: along an axis, in a plane, on a diagonal, or any. */
static void random_step(uint64_t *random, const double from[3], double to[3])
{
    const uint64_t kind = random_below(random, 4), axis = random_below(random, 3);
    const double length = (double)random_below(random, 60);
    for (uint64_t i = 0; i < 3; i++) {
        const double any = (double)random_below(random, 121) - 60;
        const double side = random_below(random, 2) == 0 ? -length : length;
        const double step[4] = {i == axis ? any : 0, i == axis ? 0 : any, side, any};
        to[i] = from[i] + step[kind];
    }
}

/* The test fails unless the sweep and the reversed sweep find what whole numbers tell. */
static void assert_true_sweep(const octree *tree, const brute *all, const double from[3], const double to[3],
                              double size)
{
    brute expected = {0}, there = {0}, back = {0};
    for (size_t i = 0; i < all->count; i++)
        if (brute_touches(from, to, size, all->points[i].position, all->points[i].position))
            brute_collect(&all->points[i], &expected);
    sweep_into(tree, from, to, size, &there);
    sweep_into(tree, to, from, size, &back);
    if (!brute_equal(&there, &expected) || !brute_equal(&back, &expected))
        fail_msg("(%g %g %g) to (%g %g %g) with %g: %zu there, %zu back, not %zu", from[0], from[1], from[2], to[0],
                 to[1], to[2], size, there.count, back.count, expected.count);
    brute_free(&expected);
    brute_free(&there);
    brute_free(&back);
}

static void swept_agrees_with_whole_numbers_at_every_capacity(void **state)
{
    (void)state;
    static const size_t shapes[][2] = {{1, 21}, {1, 3}, {2, 5}, {16, 21}, {64, 2}, {1, 0}};
    uint64_t random = 5;
    brute all = {0};
    brute_scatter(&all, &random, 500, 20, 4);
    for (size_t shape = 0; shape < sizeof shapes / sizeof shapes[0]; shape++) {
        octree *tree = brute_tree(&all, cube(-20, 20), shapes[shape][0], shapes[shape][1]);
        for (int i = 0; i < 300; i++) {
            double from[3], to[3];
            for (int axis = 0; axis < 3; axis++)
                from[axis] = (double)random_below(&random, 81) - 40; /* half of them outside the world */
            random_step(&random, from, to);
            assert_true_sweep(tree, &all, from, to, (double)random_below(&random, 9));
        }
        octree_destroy(tree);
    }
    brute_free(&all);
}

/* From (0,0) to (12,12) with size 4: the hull is cut off at the corners between the lines y = x +- 8. */
static void a_corner_that_grazes_is_touched_and_one_ulp_beside_is_not(void **state)
{
    (void)state;
    const double from[3] = {0, 0, 0}, to[3] = {12, 12, 0};
    for (int x = -4; x <= 16; x++) {
        const double above = x + 8 < 16 ? x + 8 : 16, below = x - 8 > -4 ? x - 8 : -4;
        assert_true(touches((double[3]){x, above, 4}, from, to, 4));
        assert_true(touches((double[3]){x, below, -4}, from, to, 4));
        assert_false(touches((double[3]){x, next_up(above), 4}, from, to, 4));
        assert_false(touches((double[3]){x, next_down(below), -4}, from, to, 4));
        assert_false(touches((double[3]){x, above, next_up(4)}, from, to, 4));
        assert_false(touches((double[3]){x, below, next_down(-4)}, from, to, 4));
        assert_true(touches((double[3]){x, next_down(above), next_down(4)}, from, to, 4));
    }
}

static void only_the_pair_that_is_self_is_left_out(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_GROW);
    const octree_point self = {{0, 0.5, 0}, 7};
    const octree_point zero = {{-0.0, 0.5, -0.0}, 7};
    const octree_point nobody = {{0, 0.5, 0}, 9};
    assert_int_equal(octree_insert(tree, self.position, 7), OCTREE_OK);
    assert_int_equal(octree_insert(tree, self.position, 8), OCTREE_OK);             /* same place */
    assert_int_equal(octree_insert(tree, (double[3]){0, 0.5, 0.25}, 7), OCTREE_OK); /* same id */
    const double to[3] = {0, 0.5, 1};
    assert_int_equal(hits(tree, self.position, to, 0, NULL), 3);
    assert_int_equal(hits(tree, self.position, to, 0, &self), 2);
    assert_int_equal(hits(tree, to, self.position, 0, &self), 2);
    assert_int_equal(hits(tree, self.position, to, 0, &zero), 2);
    assert_int_equal(hits(tree, self.position, self.position, 0, &self), 1);
    assert_int_equal(hits(tree, self.position, to, 0, &nobody), 3);
    octree_destroy(tree);
}

typedef struct patience {
    size_t left, visits;
} patience;

static bool visit_until_out_of_patience(const octree_point *point, void *context)
{
    (void)point;
    patience *p = context;
    p->visits++;
    return --p->left > 0;
}

static void the_visitor_can_stop_after_any_number(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_GROW);
    for (uint64_t id = 0; id < 20; id++)
        assert_int_equal(octree_insert(tree, (double[3]){0, (double)id / 20, 0}, id), OCTREE_OK);
    const double from[3] = {0, -3, 0}, to[3] = {0, 3, 0};
    for (size_t stop = 1; stop <= 21; stop++) {
        patience p = {stop, 0};
        assert_int_equal(octree_collide_swept(tree, from, to, 1, NULL, NULL, visit_until_out_of_patience, &p),
                         OCTREE_OK);
        assert_int_equal(p.visits, stop < 20 ? stop : 20);
    }
    octree_destroy(tree);
}

static void a_sweep_does_not_change_the_tree(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 1, OCTREE_REFUSE);
    const double at[3] = {0.5, 0.5, 0.5}, to[3] = {0.75, 0.75, 0.75};
    assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    assert_int_equal(hits(tree, to, at, 0.125, NULL), 1);
    assert_true(octree_digest(tree) == digest);
    assert_true(octree_version(tree) == version);
    octree_destroy(tree);
}

static void an_empty_tree_is_never_touched(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(hits(tree, (double[3]){-2, -2, -2}, (double[3]){2, 2, 2}, DBL_MAX, NULL), 0);
    octree_destroy(tree);
}

/* Steps longer than DBL_MAX, and steps of a few subnormals, whose truth is plain. */
static void steps_of_any_scale_are_decided_rightly(void **state)
{
    (void)state;
    static const struct {
        double from[3], to[3], size, at[3];
        bool touched;
    } cases[] = {
        {{-1e308, -1e308, 0}, {1e308, 1e308, 0}, 1, {0, 0, 0}, true},
        {{-1e308, -1e308, 0}, {1e308, 1e308, 0}, 1, {0.5, -1, 1}, true},
        {{-1e308, -1e308, 0}, {1e308, 1e308, 0}, 1, {1, -1, 0}, true}, /* both at t = 1/2 */
        {{-1e308, -1e308, 0}, {1e308, 1e308, 0}, 1, {1, -1.5, 0}, false},
        {{-1e308, -1e308, 0}, {1e308, 1e308, 0}, 1, {-1e308, 1e308, 0}, false}, /* the other diagonal */
        {{-1e308, -1e308, 0}, {1e308, 1e308, 0}, 1, {1e308, -1e308, 0}, false},
        {{-0x1p1023, -0x1p1023, 0}, {0x1p1023, 0x1p1023, 0}, 0x1p1019, {-0x1p1022, -0x1.8p1022, 0}, false},
        {{-0x1p1023, -0x1p1023, 0}, {0x1p1023, 0x1p1023, 0}, 0x1p1020, {-0x1p1022, -0x1.8p1022, 0}, true},
        {{-0x1p1023, -0x1p1023, 0}, {0x1p1023, 0x1p1023, 0}, 0x1p1019, {0x1p1022, 0x1.8p1022, 0}, false},
        {{-0x1p1023, -0x1p1023, 0}, {0x1p1023, 0x1p1023, 0}, 0x1p1020, {0x1p1022, 0x1.8p1022, 0}, true},
        {{-DBL_MAX, -DBL_MAX, 0}, {DBL_MAX, DBL_MAX, 0}, 0, {1e308, 1e308, 0}, true},
        {{-DBL_MAX, -DBL_MAX, 0}, {DBL_MAX, DBL_MAX, 0}, 0, {1e308, 1.5e308, 0}, false},
        {{-DBL_MAX, 0, 0}, {DBL_MAX, 9, 0}, 1, {0, 4.5, 0}, true},
        {{-DBL_MAX, 0, 0}, {DBL_MAX, 9, 0}, 1, {0, 5.5, 0}, true},
        {{-DBL_MAX, 0, 0}, {DBL_MAX, 9, 0}, 1, {0, 6, 0}, false},
        {{-1e308, -1e308, 0}, {1e308, 1e308, 0}, 1e308, {-1e308, 1e308, 0}, true}, /* at t = 1/2 */
        {{-1e308, -1e308, 0}, {1e308, 1e308, 0}, 9e307, {-1e308, 1e308, 0}, false},
        {{-DBL_MAX, 0, 0}, {DBL_MAX, 1, 0}, 0.25, {-DBL_MAX / 2, 1, 0}, false},
        {{-DBL_MAX, 0, 0}, {DBL_MAX, 1, 0}, 0.25, {0, 0.5, 0}, true},
        {{-DBL_MAX, 0, 0}, {DBL_MAX, 1, 0}, 0.25, {DBL_MAX / 2, 0.5, 0.25}, true},
        {{-DBL_MAX, 0, 0}, {DBL_MAX, 1, 0}, 0.25, {-DBL_MAX, 0.5, 0}, false},
        {{-DBL_MAX, 0, 0}, {DBL_MAX, 0, 0}, 0, {DBL_MAX, 5e-324, 0}, false},
        {{-DBL_MAX, 0, 0}, {DBL_MAX, 0, 0}, 0, {DBL_MAX, 0, 0}, true},
        {{DBL_MAX, DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX, -DBL_MAX}, 0, {3, 3, 3}, true},
        {{DBL_MAX, DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX, -DBL_MAX}, 0, {3, 3, 4}, false},
        {{DBL_MAX, DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX, -DBL_MAX}, DBL_MAX, {DBL_MAX, -DBL_MAX, 0}, true},
        {{0, 0, 0}, {1e-323, 1e-323, 0}, 0, {5e-324, 5e-324, 0}, true},
        {{0, 0, 0}, {1e-323, 1e-323, 0}, 0, {5e-324, 0, 0}, false},
        {{0, 0, 0}, {1.5e-323, 1.5e-323, 0}, 5e-324, {1e-323, 0, 0}, true},
        {{0, 0, 0}, {1.5e-323, 1.5e-323, 0}, 5e-324, {1.5e-323, 0, 0}, false},
        {{0, 0, 0}, {1e308, 1e-323, 0}, 0, {0, 5e-324, 0}, false},
        {{0, 0, 0}, {0x1p1023, 0x1p-1073, 0}, 0, {0x1p1022, 0x1p-1074, 0}, true},
        {{0, 0, 0}, {0x1p1023, 0x1p-1073, 0}, 0, {0x1.0000000000001p1022, 0x1p-1074, 0}, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (touches(cases[i].at, cases[i].from, cases[i].to, cases[i].size) != cases[i].touched)
            fail_msg("case %zu: %s", i, cases[i].touched ? "touched" : "not touched");
        if (touches(cases[i].at, cases[i].to, cases[i].from, cases[i].size) != cases[i].touched)
            fail_msg("case %zu, reversed: %s", i, cases[i].touched ? "touched" : "not touched");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(swept_refuses_null),
        cmocka_unit_test(swept_refuses_bad_sizes_and_places),
        cmocka_unit_test(a_diagonal_step_meets_the_point_that_both_ends_miss),
        cmocka_unit_test(rows_two_boxes_apart_stop_every_step),
        cmocka_unit_test(a_slanted_wall_stops_every_step),
        cmocka_unit_test(a_box_of_no_size_meets_the_points_on_its_line_and_no_others),
        cmocka_unit_test(a_step_of_no_length_is_a_collision_test),
        cmocka_unit_test(steps_of_two_boxes_along_one_axis_need_no_sweep),
        cmocka_unit_test(one_ulp_more_than_two_boxes_leaves_a_gap_that_the_sweep_closes),
        cmocka_unit_test(swept_agrees_with_whole_numbers_at_every_capacity),
        cmocka_unit_test(a_corner_that_grazes_is_touched_and_one_ulp_beside_is_not),
        cmocka_unit_test(only_the_pair_that_is_self_is_left_out),
        cmocka_unit_test(the_visitor_can_stop_after_any_number),
        cmocka_unit_test(a_sweep_does_not_change_the_tree),
        cmocka_unit_test(an_empty_tree_is_never_touched),
        cmocka_unit_test(steps_of_any_scale_are_decided_rightly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
