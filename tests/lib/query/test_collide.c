/* SPDX-License-Identifier: MIT */
/* test_collide.c - Algorithm 5: points within the box by exact comparison; the tree stays unchanged. */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "brute.h"

static size_t hits(const octree *tree, const double center[3], double size, const octree_point *self)
{
    brute found = {0};
    assert_int_equal(octree_collide(tree, center, size, self, brute_collect, &found), OCTREE_OK);
    size_t count = found.count;
    brute_free(&found);
    return count;
}

static void collide_refuses_bad_sizes_and_centres(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    const double at[3] = {0, 0, 0};
    octree_box box;
    brute found = {0};
    static const struct {
        double size;
        octree_status status;
    } sizes[] = {
        {-1, OCTREE_BAD_SIZE}, {-5e-324, OCTREE_BAD_SIZE}, {NAN, OCTREE_NOT_FINITE}, {INFINITY, OCTREE_NOT_FINITE},
        {0, OCTREE_OK},        {-0.0, OCTREE_OK},          {DBL_MAX, OCTREE_OK}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        assert_int_equal(octree_collide(tree, at, sizes[i].size, NULL, brute_collect, &found), sizes[i].status);
        assert_int_equal(octree_collision_box(at, sizes[i].size, &box), sizes[i].status);
    }
    static const double values[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 9; i++) {
        double center[3] = {0, 0, 0};
        center[i % 3] = values[i / 3];
        assert_int_equal(octree_collide(tree, center, 1, NULL, brute_collect, &found), OCTREE_NOT_FINITE);
        assert_int_equal(octree_collision_box(center, 1, &box), OCTREE_NOT_FINITE);
    }
    assert_int_equal(found.count, 0);
    octree_destroy(tree);
}

static void a_point_at_exactly_box_size_is_hit_and_one_ulp_further_is_not(void **state)
{
    (void)state;
    const double center[3] = {64, 64, 64};
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side <= 1; side += 2) {
            double edge = 64 + side * 30.0;
            double out = side > 0 ? next_up(edge) : next_down(edge);
            double in = side > 0 ? next_down(edge) : next_up(edge);
            double corner[3] = {94, 94, 94};
            const double expected[][2] = {{edge, 1}, {out, 0}, {in, 1}};
            for (int i = 0; i < 3; i++) {
                octree *tree = make_tree(cube(0, 128), 1, 21, OCTREE_REFUSE);
                corner[axis] = expected[i][0];
                assert_int_equal(octree_insert(tree, corner, 1), OCTREE_OK);
                assert_true((double)hits(tree, center, 30, NULL) == expected[i][1]);
                octree_destroy(tree);
            }
        }
}

static void collide_decides_by_real_numbers_where_sums_round(void **state)
{
    (void)state;
    /* 1 + 2^-53 rounds to 1, and 1 + 3 * 2^-53 to 1 + 2^-51: the rounded box has other points than the real one. */
    static const struct {
        double center, size, p;
        bool hit;
    } cases[] = {
        {1, 0x1p-53, 1, true},
        {1, 0x1p-53, 1 + 0x1p-52, false},
        {1, 0x1.8p-52, 1 + 0x1p-51, false},
        {1, 0x1.8p-52, 1 + 0x1p-52, true},
        {1, 0x1p-60, 1, true},
        {1, 0x1p-54, 1 - 0x1p-53, false},
        {1, 0x1p-53, 1 - 0x1p-53, true},
        {0.1, 0.2, 0.3, true},                  /* the real 0.1 + 0.2 is above the double 0.3 */
        {0.1, 0.2, 0.30000000000000004, false}, /* which is what the sum rounds to */
        {1e-300, 1, 1, true},                   /* the sum forgets the centre */
        {-1e-300, 1, 1, false},
        {1e-300, 1, -1, false},
        {-1e-300, 1, -1, true},
        {5e-324, 5e-324, 0, true},
        {5e-324, 5e-324, 1e-323, true},
        {5e-324, 5e-324, 1.5e-323, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        octree *tree = make_tree(cube(-2, 2), 1, 21, OCTREE_REFUSE);
        assert_int_equal(octree_insert(tree, (double[3]){0, cases[i].p, 0}, 1), OCTREE_OK);
        size_t count = hits(tree, (double[3]){0, cases[i].center, 0}, cases[i].size, NULL);
        if (count != (cases[i].hit ? 1u : 0u))
            fail_msg("case %zu: %.17g within %.17g of %.17g", i, cases[i].p, cases[i].size, cases[i].center);
        octree_destroy(tree);
    }
}

static void only_the_pair_that_is_self_is_left_out(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_GROW);
    const octree_point self = {{0, 0.5, 0}, 7};
    const octree_point zero = {{-0.0, 0.5, 0}, 7};
    assert_int_equal(octree_insert(tree, self.position, 7), OCTREE_OK);
    assert_int_equal(octree_insert(tree, self.position, 8), OCTREE_OK);             /* same place */
    assert_int_equal(octree_insert(tree, (double[3]){0, 0.5, 0.25}, 7), OCTREE_OK); /* same id */
    assert_int_equal(hits(tree, self.position, 0.5, NULL), 3);
    assert_int_equal(hits(tree, self.position, 0.5, &self), 2);
    assert_int_equal(hits(tree, self.position, 0.5, &zero), 2);
    assert_int_equal(hits(tree, self.position, 0, &self), 1);
    const octree_point nobody = {{0, 0.5, 0}, 9};
    assert_int_equal(hits(tree, self.position, 0.5, &nobody), 3);
    octree_destroy(tree);
}

static void collide_does_not_change_the_tree(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 1, OCTREE_REFUSE);
    const double at[3] = {0.5, 0.5, 0.5};
    assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
    uint64_t digest = octree_digest(tree), version = octree_version(tree);
    assert_int_equal(hits(tree, at, 0.25, NULL), 1); /* the leaf is full: the paper's test would lose this point */
    assert_true(octree_digest(tree) == digest);
    assert_true(octree_version(tree) == version);
    octree_destroy(tree);
}

static void the_centre_may_lie_far_outside_the_world(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){1, 1, 1}, 1), OCTREE_OK);
    assert_int_equal(hits(tree, (double[3]){3, 3, 3}, 2, NULL), 1);
    assert_int_equal(hits(tree, (double[3]){3, 3, next_up(3)}, 2, NULL), 0);
    assert_int_equal(hits(tree, (double[3]){1e300, 1, 1}, 1e300, NULL), 1);
    assert_int_equal(hits(tree, (double[3]){-1e300, 1, 1}, 1e300, NULL), 0); /* 1e300 + 1 away */
    assert_int_equal(hits(tree, (double[3]){DBL_MAX, -DBL_MAX, 0}, DBL_MAX, NULL), 0);
    assert_int_equal(hits(tree, (double[3]){DBL_MAX, DBL_MAX, 1}, DBL_MAX, NULL), 1);
    octree_destroy(tree);
}

static bool stop_at_once(const octree_point *point, void *context)
{
    (void)point;
    ++*(size_t *)context;
    return false;
}

static void the_visitor_can_stop(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_GROW);
    for (uint64_t id = 0; id < 20; id++)
        assert_int_equal(octree_insert(tree, (double[3]){0, (double)id / 20, 0}, id), OCTREE_OK);
    size_t visits = 0;
    assert_int_equal(octree_collide(tree, (double[3]){0}, 1, NULL, stop_at_once, &visits), OCTREE_OK);
    assert_int_equal(visits, 1);
    octree_destroy(tree);
}

static void assert_tight(double center, double size, double low, double high)
{
    assert_true(isfinite(low) && isfinite(high));
    assert_true(brute_is_within(center, size, low) && brute_is_within(center, size, high));
    assert_true(low == -DBL_MAX || !brute_is_within(center, size, next_down(low)));
    assert_true(high == DBL_MAX || !brute_is_within(center, size, next_up(high)));
}

static void the_collision_box_is_the_largest_box_of_doubles_within(void **state)
{
    (void)state;
    static const double values[] = {0, 5e-324,      1e-310, 0x1p-1022, 1e-200, 0x1p-53,     0.1,    0.2,
                                    1, 1 + 0x1p-52, 30,     1e15,      1e200,  DBL_MAX / 2, DBL_MAX};
    size_t count = sizeof values / sizeof values[0];
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++) {
            double center[3] = {values[i], -values[i], values[i] / 3};
            octree_box box;
            assert_int_equal(octree_collision_box(center, values[j], &box), OCTREE_OK);
            for (int axis = 0; axis < 3; axis++)
                assert_tight(center[axis], values[j], box.min[axis], box.max[axis]);
            octree_box own = {{center[0], center[1], center[2]}, {0}};
            assert_int_equal(octree_collision_box(own.min, values[j], &own), OCTREE_OK);
            assert_memory_equal(&own, &box, sizeof box);
        }
}

static void a_box_as_large_as_doubles_allow_ends_within_its_size(void **state)
{
    (void)state;
    const double center = -0x1.776bca69c02d8p+1019, last = 0x1.e889435963fd1p+1023;
    octree_box box;
    assert_int_equal(octree_collision_box((double[3]){center, -center, 0}, DBL_MAX, &box), OCTREE_OK);
    assert_true(box.max[0] == last && box.min[1] == -last); /* the next one is half an ulp beyond */
    octree *tree = make_tree(cube(-DBL_MAX, DBL_MAX), 1, 21, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){next_up(last), 0, 0}, 1), OCTREE_OK);
    assert_int_equal(hits(tree, (double[3]){center, 0, 0}, DBL_MAX, NULL), 0);
    octree_destroy(tree);
}

/* A centre and a size whose sum rounds, and a point within two ulps of the edge. */
static void random_near_edge(uint64_t *random, double *center, double *size, double *p)
{
    *center = random_between(random, -1, 1);
    *size = random_between(random, 0, 1);
    *p = random_below(random, 2) == 0 ? *center + *size : *center - *size;
    for (uint64_t steps = random_below(random, 3); steps > 0; steps--)
        *p = random_below(random, 2) == 0 ? next_up(*p) : next_down(*p);
}

static void collide_is_exact_within_two_ulps_of_its_faces(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < 3000; i++) {
        double center[3] = {0.25, 0.25, 0.25}, at[3] = {0.25, 0.25, 0.25}, size;
        int axis = i % 3;
        random_near_edge(&random, &center[axis], &size, &at[axis]);
        octree *tree = make_tree(cube(-3, 3), 1, 21, OCTREE_REFUSE);
        assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
        assert_int_equal(octree_insert(tree, (double[3]){-3, -3, -3}, 2), OCTREE_OK);
        assert_int_equal(hits(tree, center, size, NULL), brute_is_within(center[axis], size, at[axis]) ? 1 : 0);
        octree_destroy(tree);
    }
}

static void collide_agrees_with_a_scan(void **state)
{
    (void)state;
    uint64_t random = 9;
    octree *tree = make_tree(cube(-10, 10), 3, 6, OCTREE_GROW);
    brute all = {0};
    for (uint64_t id = 0; id < 800; id++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = ((double)random_below(&random, 201) - 100) * 0.1;
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
        brute_insert(&all, at, id);
    }
    for (int i = 0; i < 1000; i++) {
        const octree_point *self = &all.points[random_below(&random, all.count)];
        double size = (double)random_below(&random, 50) * 0.1;
        brute expected = {0}, found = {0};
        brute_collide(&all, self->position, size, self, &expected);
        assert_int_equal(octree_collide(tree, self->position, size, self, brute_collect, &found), OCTREE_OK);
        assert_true(brute_equal(&expected, &found));
        brute_free(&expected);
        brute_free(&found);
    }
    brute_free(&all);
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(collide_refuses_bad_sizes_and_centres),
        cmocka_unit_test(a_point_at_exactly_box_size_is_hit_and_one_ulp_further_is_not),
        cmocka_unit_test(collide_decides_by_real_numbers_where_sums_round),
        cmocka_unit_test(only_the_pair_that_is_self_is_left_out),
        cmocka_unit_test(collide_does_not_change_the_tree),
        cmocka_unit_test(the_centre_may_lie_far_outside_the_world),
        cmocka_unit_test(the_visitor_can_stop),
        cmocka_unit_test(the_collision_box_is_the_largest_box_of_doubles_within),
        cmocka_unit_test(a_box_as_large_as_doubles_allow_ends_within_its_size),
        cmocka_unit_test(collide_is_exact_within_two_ulps_of_its_faces),
        cmocka_unit_test(collide_agrees_with_a_scan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
