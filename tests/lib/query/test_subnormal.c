/* SPDX-License-Identifier: MIT */
/* test_subnormal.c - a world of whole numbers times 2^-1074, where all coordinates are subnormal and products with them
 * take a way of their own, answers as the world of those numbers does, at the same cost. test_exact_queries.c has the
 * truth about both.
 */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "brute.h"

enum { POINTS = 3000, QUERIES = 400, K = 5 };

/* Below 2^51 the planes of all depths are whole, too. */
static const double reach = 0x1p50;

static double shrunk(double whole)
{
    return ldexp(whole, -1074);
}

/* The same places twice. */
typedef struct twins {
    octree *whole, *small;
    uint64_t random;
} twins;

static double whole_between(uint64_t *random, double low, double high)
{
    return floor(random_between(random, low, high));
}

/* Everywhere, or so near the middle that many distances are a few units. */
static void any_place(uint64_t *random, double whole[3], double small[3])
{
    const double bound = random_below(random, 2) == 0 ? reach : 8;
    for (int axis = 0; axis < 3; axis++) {
        whole[axis] = whole_between(random, -bound, bound);
        small[axis] = shrunk(whole[axis]);
    }
}

static twins make_twins(void)
{
    twins t = {.random = 1};
    t.whole = make_tree(cube(-reach, reach), 4, 21, OCTREE_GROW);
    t.small = make_tree(cube(shrunk(-reach), shrunk(reach)), 4, 21, OCTREE_GROW);
    for (uint64_t id = 0; id < POINTS; id++) {
        double whole[3], small[3];
        any_place(&t.random, whole, small);
        assert_int_equal(octree_insert(t.whole, whole, id), OCTREE_OK);
        assert_int_equal(octree_insert(t.small, small, id), OCTREE_OK);
    }
    assert_valid(t.small);
    return t;
}

static void destroy_twins(twins *t)
{
    octree_destroy(t->whole);
    octree_destroy(t->small);
}

static bool mark(const octree_point *point, void *context)
{
    ((bool *)context)[point->id] ^= true;
    return true;
}

static void assert_same_cost(const octree_cost *a, const octree_cost *b)
{
    assert_true(a->nodes == b->nodes && a->leaves == b->leaves && a->points == b->points && a->pruned == b->pruned);
}

/* Distances of nodes in keys have an error of some units, so a search of the world of whole numbers may look further.
 */
static void assert_no_greater_cost(const octree_cost *small, const octree_cost *whole)
{
    assert_true(small->nodes <= whole->nodes && small->leaves <= whole->leaves && small->points <= whole->points);
}

typedef enum asked { BOX, BALL, COLLISION, SWEEP, ASKED } asked;

/* One question to one of the twins; */
static void ask(const octree *tree, asked what, const double from[3], const double to[3], double size, bool *marks,
                octree_cost *cost)
{
    const octree_search how = {.cost = cost};
    octree_box box;
    octree_status status = OCTREE_OK;
    for (int axis = 0; axis < 3; axis++) {
        box.min[axis] = fmin(from[axis], to[axis]);
        box.max[axis] = fmax(from[axis], to[axis]);
    }
    if (what == BOX)
        status = octree_range_search(tree, &box, &how, mark, marks);
    else if (what == BALL)
        status = octree_radius(tree, from, size, &how, mark, marks);
    else if (what == COLLISION)
        status = octree_collide_search(tree, from, size, NULL, &how, mark, marks);
    else
        status = octree_collide_swept(tree, from, to, size, NULL, &how, mark, marks);
    assert_int_equal(status, OCTREE_OK);
}

static void regions_hold_the_same_points_at_the_same_cost(void **state)
{
    (void)state;
    twins t = make_twins();
    for (int i = 0; i < QUERIES; i++) {
        double whole[2][3], small[2][3];
        any_place(&t.random, whole[0], small[0]);
        any_place(&t.random, whole[1], small[1]);
        const double size = whole_between(&t.random, 0, i % 3 == 0 ? 8 : reach / 4);
        bool marks[POINTS] = {false};
        octree_cost of_whole = {0}, of_small = {0};
        ask(t.whole, (asked)(i % ASKED), whole[0], whole[1], size, marks, &of_whole);
        ask(t.small, (asked)(i % ASKED), small[0], small[1], shrunk(size), marks, &of_small);
        for (size_t id = 0; id < POINTS; id++)
            assert_false(marks[id]); /* marked by none, or by both */
        assert_same_cost(&of_whole, &of_small);
    }
    destroy_twins(&t);
}

static void neighbors_are_the_same_at_no_greater_cost(void **state)
{
    (void)state;
    twins t = make_twins();
    for (int i = 0; i < QUERIES; i++) {
        double whole[3], small[3];
        octree_neighbor of_whole[K], of_small[K];
        octree_cost cost_whole = {0}, cost_small = {0};
        const octree_mode mode = i % 2 ? OCTREE_FAST : OCTREE_EXACT;
        size_t count_whole, count_small;
        any_place(&t.random, whole, small);
        assert_int_equal(octree_nearest_k(t.whole, whole, K, &(octree_search){.mode = mode, .cost = &cost_whole},
                                          of_whole, &count_whole),
                         OCTREE_OK);
        assert_int_equal(octree_nearest_k(t.small, small, K, &(octree_search){.mode = mode, .cost = &cost_small},
                                          of_small, &count_small),
                         OCTREE_OK);
        assert_true(count_whole == K && count_small == K);
        for (size_t j = 0; j < K; j++) {
            assert_true(of_small[j].point.id == of_whole[j].point.id);
            assert_true(of_small[j].distance == shrunk(of_whole[j].distance));
        }
        assert_no_greater_cost(&cost_small, &cost_whole);
    }
    destroy_twins(&t);
}

/* Targets that are no subnormals are asked of a world that is of nothing else. */
static void targets_far_outside_have_the_same_neighbors(void **state)
{
    (void)state;
    twins t = make_twins();
    for (int i = 0; i < QUERIES; i++) {
        octree_neighbor of_whole, of_small;
        double whole[3], small[3];
        any_place(&t.random, whole, small);
        whole[i % 3] = ldexp(i % 2 ? 1 : -1, 51 + i % 900);
        small[i % 3] = shrunk(whole[i % 3]);
        assert_int_equal(octree_nearest(t.whole, whole, OCTREE_SKIP_NONE, 0, &of_whole), OCTREE_OK);
        assert_int_equal(octree_nearest(t.small, small, OCTREE_SKIP_NONE, 0, &of_small), OCTREE_OK);
        assert_true(of_small.point.id == of_whole.point.id);
    }
    destroy_twins(&t);
}

static void nodes_are_the_same_after_removals(void **state)
{
    (void)state;
    twins t = make_twins();
    uint64_t random = 1;
    for (uint64_t id = 0; id < POINTS; id++) { /* the same places once more */
        double whole[3], small[3];
        any_place(&random, whole, small);
        if (id % 3 == 0)
            continue;
        assert_int_equal(octree_remove(t.whole, whole, id), OCTREE_OK);
        assert_int_equal(octree_remove(t.small, small, id), OCTREE_OK);
    }
    octree_stats of_whole, of_small;
    assert_int_equal(octree_statistics(t.whole, &of_whole), OCTREE_OK);
    assert_int_equal(octree_statistics(t.small, &of_small), OCTREE_OK);
    assert_memory_equal(of_whole.nodes_at_depth, of_small.nodes_at_depth, sizeof of_whole.nodes_at_depth);
    assert_memory_equal(of_whole.leaves_at_depth, of_small.leaves_at_depth, sizeof of_whole.leaves_at_depth);
    assert_valid(t.small);
    destroy_twins(&t);
}

/* Worlds that are subnormal on some axes alone: answers are those of a scan. */
static void worlds_may_be_subnormal_on_some_axes(void **state)
{
    (void)state;
    for (int axes = 1; axes < 7; axes++) {
        octree_box world;
        for (int axis = 0; axis < 3; axis++) {
            world.max[axis] = axes >> axis & 1 ? 1e-309 : 1e-300;
            world.min[axis] = -world.max[axis];
        }
        octree *tree = make_tree(world, 4, 21, OCTREE_GROW);
        brute all = {0};
        uint64_t random = (uint64_t)axes;
        for (uint64_t id = 0; id < 300; id++) {
            double at[3];
            for (int axis = 0; axis < 3; axis++)
                at[axis] = random_between(&random, world.min[axis], world.max[axis]);
            assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
            brute_insert(&all, at, id);
        }
        assert_valid(tree);
        octree_box half = world;
        half.min[axes % 3] = 0;
        brute found = {0}, expected = {0};
        assert_int_equal(octree_range(tree, &half, brute_collect, &found), OCTREE_OK);
        for (size_t i = 0; i < all.count; i++)
            if (box_holds(&half, all.points[i].position))
                brute_collect(&all.points[i], &expected);
        assert_true(found.count > 100 && brute_equal(&found, &expected));
        for (size_t i = 0; i < all.count; i++) {
            octree_neighbor nearest;
            assert_int_equal(octree_nearest(tree, all.points[i].position, OCTREE_SKIP_NONE, 0, &nearest), OCTREE_OK);
            assert_int_equal(nearest.point.id, all.points[i].id);
        }
        brute_free(&found);
        brute_free(&expected);
        brute_free(&all);
        octree_destroy(tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regions_hold_the_same_points_at_the_same_cost),
        cmocka_unit_test(neighbors_are_the_same_at_no_greater_cost),
        cmocka_unit_test(targets_far_outside_have_the_same_neighbors),
        cmocka_unit_test(nodes_are_the_same_after_removals),
        cmocka_unit_test(worlds_may_be_subnormal_on_some_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
