/* SPDX-License-Identifier: MIT */
/* test_nearest_k.c - the k nearest points: count, order and skipped points, for any shape of the tree. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "brute.h"

static const octree_neighbor untouched = {{{-7, -7, -7}, 777}, -7};

static bool same_neighbor(const octree_neighbor *a, const octree_neighbor *b)
{
    return a->point.id == b->point.id && same_position(a->point.position, b->point.position) &&
           a->distance == b->distance;
}

/* Ask for k with room for `expected` results alone, and one more that must stay as it was. To be freed. */
static octree_neighbor *ask(const octree *tree, const double target[3], size_t k, const octree_search *how,
                            size_t expected)
{
    octree_neighbor *found = malloc((expected + 1) * sizeof *found);
    assert_non_null(found);
    found[expected] = untouched;
    size_t count = SIZE_MAX;
    assert_int_equal(octree_nearest_k(tree, target, k, how, found, &count), OCTREE_OK);
    assert_int_equal(count, expected);
    assert_true(same_neighbor(&found[expected], &untouched));
    return found;
}

/* The test fails unless the k nearest are those of a scan, in its order. */
static void assert_scan(const octree *tree, const brute *all, const double target[3], size_t k, octree_skip skip,
                        uint64_t skip_id)
{
    octree_neighbor *expected;
    size_t count = brute_nearest_k(all, target, k, skip, skip_id, &expected);
    const octree_search how = {.skip = skip, .skip_id = skip_id};
    octree_neighbor *found = ask(tree, target, k, &how, count);
    for (size_t i = 0; i < count; i++)
        if (!same_neighbor(&found[i], &expected[i]))
            fail_msg("of %zu, number %zu is %llu at %.17g, not %llu at %.17g", k, i,
                     (unsigned long long)found[i].point.id, found[i].distance, (unsigned long long)expected[i].point.id,
                     expected[i].distance);
    free(found);
    free(expected);
}

static void nearest_k_refuses_invalid_arguments(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    insert_all(tree, (const double[][3]){{0, 0, 0}, {1, 1, 1}}, 2);
    static const double values[] = {NAN, INFINITY, -INFINITY};
    octree_neighbor found[2];
    size_t count;
    for (int i = 0; i < 9; i++) {
        double target[3] = {0, 0, 0};
        target[i % 3] = values[i / 3];
        count = 777;
        assert_int_equal(octree_nearest_k(tree, target, 2, NULL, found, &count), OCTREE_NOT_FINITE);
        assert_int_equal(count, 0);
    }
    count = 777;
    assert_int_equal(octree_nearest_k(NULL, (double[3]){0}, 2, NULL, found, &count), OCTREE_NULL_ARGUMENT);
    assert_int_equal(count, 0);
    static const struct {
        octree_search how;
        octree_status status;
    } searches[] = {
        {{.skip = (octree_skip)3}, OCTREE_BAD_OPTION}, {{.skip = (octree_skip)-1}, OCTREE_BAD_OPTION},
        {{.mode = (octree_mode)2}, OCTREE_BAD_OPTION}, {{.mode = (octree_mode)-1}, OCTREE_BAD_OPTION},
        {{.epsilon = NAN}, OCTREE_NOT_FINITE},         {{.epsilon = INFINITY}, OCTREE_NOT_FINITE},
        {{.epsilon = -INFINITY}, OCTREE_NOT_FINITE},   {{.epsilon = -1}, OCTREE_BAD_SIZE},
        {{.epsilon = -5e-324}, OCTREE_BAD_SIZE},       {{.epsilon = -0.0}, OCTREE_OK},
    };
    for (size_t i = 0; i < sizeof searches / sizeof searches[0]; i++)
        assert_int_equal(octree_nearest_k(tree, (double[3]){0}, 2, &searches[i].how, found, &count),
                         searches[i].status);
    octree_destroy(tree);
}

static void k_is_cut_to_the_points_that_count(void **state)
{
    (void)state;
    enum { n = 100 };
    static const size_t asked[] = {0, 1, 2, 32, 33, n - 1, n, n + 1, UINT32_MAX, SIZE_MAX / 2, SIZE_MAX};
    uint64_t random = 1;
    brute all = {0};
    brute_scatter(&all, &random, n, 50, UINT64_MAX);
    assert_int_equal(all.count, n);
    octree *tree = brute_tree(&all, cube(-50, 50), 3, 21);
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++)
        for (int skip = 0; skip < 3; skip++) /* the target is a point: one is skipped */
            assert_scan(tree, &all, all.points[17].position, asked[i], (octree_skip)skip, all.points[17].id);
    brute_free(&all);
    octree_destroy(tree);
}

static void an_empty_tree_has_no_neighbors(void **state)
{
    (void)state;
    static const size_t asked[] = {0, 1, 5, SIZE_MAX};
    octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_REFUSE);
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++)
        free(ask(tree, (double[3]){0.5, 7, 1e300}, asked[i], NULL, 0));
    assert_int_equal(octree_insert(tree, (double[3]){0}, 4), OCTREE_OK);
    free(ask(tree, (double[3]){0}, SIZE_MAX, &(octree_search){.skip = OCTREE_SKIP_ID, .skip_id = 4}, 0));
    free(ask(tree, (double[3]){0}, SIZE_MAX, &(octree_search){.skip = OCTREE_SKIP_COINCIDENT}, 0));
    assert_int_equal(octree_remove(tree, (double[3]){0}, 4), OCTREE_OK);
    free(ask(tree, (double[3]){0}, 3, NULL, 0));
    octree_destroy(tree);
}

static void equal_distances_are_in_order_of_id_then_position(void **state)
{
    (void)state;
    /* All 3 or 5 away from the origin, inserted in an order that is none of these. */
    static const octree_point sorted[] = {
        {{-3, 0, 0}, 1}, {{0, -3, 0}, 1}, {{0, 0, -3}, 1}, {{0, 0, 3}, 1}, {{0, 3, 0}, 1},
        {{3, 0, 0}, 1},  {{1, 2, 2}, 2},  {{2, -2, 1}, 2}, {{0, 3, 0}, 3}, {{-2, 1, -2}, UINT64_MAX},
        {{-4, 0, 3}, 0}, {{3, 4, 0}, 0},  {{-5, 0, 0}, 9},
    };
    enum { n = sizeof sorted / sizeof sorted[0] };
    for (size_t capacity = 1; capacity <= n; capacity++) {
        octree *tree = make_tree(cube(-8, 8), capacity, 6, OCTREE_GROW);
        for (size_t i = 0; i < n; i++) {
            const octree_point *point = &sorted[(i * 5 + capacity) % n];
            assert_int_equal(octree_insert(tree, point->position, point->id), OCTREE_OK);
        }
        for (size_t k = 0; k <= n; k++) {
            octree_neighbor *found = ask(tree, (double[3]){0}, k, NULL, k);
            for (size_t i = 0; i < k; i++)
                assert_true(same_neighbor(&found[i], &(octree_neighbor){sorted[i], i < 10 ? 3 : 5}));
            free(found);
        }
        octree_destroy(tree);
    }
}

static void many_ids_at_one_position_come_lowest_first(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 2, 21, OCTREE_GROW);
    const double here[3] = {1, -2, 3};
    for (uint64_t i = 0; i < 100; i++)
        assert_int_equal(octree_insert(tree, here, i * 37 % 100), OCTREE_OK);
    octree_neighbor *found = ask(tree, here, 40, &(octree_search){.skip = OCTREE_SKIP_ID, .skip_id = 20}, 40);
    for (uint64_t i = 0; i < 40; i++)
        assert_true(found[i].point.id == i + (i >= 20) && found[i].distance == 0);
    free(found);
    free(ask(tree, here, 40, &(octree_search){.skip = OCTREE_SKIP_COINCIDENT}, 0));
    octree_destroy(tree);
}

static void a_skipped_id_is_left_out_wherever_it_is_stored(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 1, 21, OCTREE_GROW);
    for (int x = -8; x <= 8; x++)
        assert_int_equal(octree_insert(tree, (double[3]){x, 0, 0}, x % 2 == 0 ? 5 : 6), OCTREE_OK);
    octree_neighbor *found = ask(tree, (double[3]){0}, 17, &(octree_search){.skip = OCTREE_SKIP_ID, .skip_id = 5}, 8);
    for (size_t i = 0; i < 8; i++)
        assert_true(found[i].point.id == 6 && found[i].distance == (double)(i / 2 * 2 + 1));
    free(found);
    found = ask(tree, (double[3]){-0.0, 0, 0}, 3, &(octree_search){.skip = OCTREE_SKIP_COINCIDENT}, 3);
    assert_true(found[0].distance == 1 && found[0].point.position[0] == -1);
    free(found);
    found = ask(tree, (double[3]){0}, 3, &(octree_search){.skip_id = 5}, 3); /* the id is not read */
    assert_true(found[0].distance == 0 && found[0].point.id == 5);
    free(found);
    octree_destroy(tree);
}

static void nearest_k_agrees_with_a_scan(void **state)
{
    (void)state;
    static const size_t asked[] = {1, 2, 3, 8, 31, 200};
    for (uint64_t seed = 0; seed < 40; seed++) {
        uint64_t random = seed;
        brute all = {0};
        brute_scatter(&all, &random, 200, 2 + seed, 60); /* crowded first: many ties, many ids that repeat */
        octree *tree = brute_tree(&all, cube(-64, 64), 1 + seed % 7, seed % 22);
        for (int i = 0; i < 60; i++) {
            double target[3];
            for (int axis = 0; axis < 3; axis++)
                target[axis] = (double)random_below(&random, 321) / 2 - 80; /* on points, halfway, outside */
            assert_scan(tree, &all, target, asked[i % 6], (octree_skip)(i % 3), random_below(&random, 60));
        }
        brute_free(&all);
        octree_destroy(tree);
    }
}

static void one_neighbor_is_the_nearest(void **state)
{
    (void)state;
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++) {
        octree_box world = cube(-1, 1);
        uint64_t random = 3;
        brute all = {0};
        brute_sample(&all, (octree_sample_kind)kind, 5, &world, 500);
        octree *tree = brute_tree(&all, world, 4, 21);
        for (int i = 0; i < 200; i++) {
            double target[3];
            for (int axis = 0; axis < 3; axis++)
                target[axis] = random_between(&random, -1.5, 1.5);
            const octree_search how = {.skip = (octree_skip)(i % 3), .skip_id = random_below(&random, 500)};
            octree_neighbor nearest;
            assert_int_equal(octree_nearest(tree, target, how.skip, how.skip_id, &nearest), OCTREE_OK);
            octree_neighbor *found = ask(tree, target, 1, &how, 1);
            assert_true(same_neighbor(found, &nearest));
            free(found);
        }
        brute_free(&all);
        octree_destroy(tree);
    }
}

static void multiply(brute *all, double scale)
{
    for (size_t i = 0; i < all->count; i++)
        for (int axis = 0; axis < 3; axis++)
            all->points[i].position[axis] *= scale;
}

static void the_order_is_the_true_one_where_squares_overflow_or_vanish(void **state)
{
    (void)state;
    static const double scales[] = {0x1p663, 0x1p1013, 0x1p-663, 0x1p-1040, 0x1p-1074}; /* 1e200 ... the least double */
    for (size_t s = 0; s < sizeof scales / sizeof scales[0]; s++) {
        uint64_t random = s;
        brute whole = {0}, scaled = {0};
        brute_scatter(&whole, &random, 150, 512, 40);
        for (size_t i = 0; i < whole.count; i++)
            brute_collect(&whole.points[i], &scaled);
        multiply(&scaled, scales[s]);
        octree *tree = brute_tree(&scaled, cube(-512 * scales[s], 512 * scales[s]), 2, 21);
        for (int i = 0; i < 50; i++) {
            double target[3], there[3];
            for (int axis = 0; axis < 3; axis++) {
                target[axis] = (double)random_below(&random, 2049) - 1024;
                there[axis] = target[axis] * scales[s];
            }
            octree_neighbor *expected;
            size_t count = brute_nearest_k(&whole, target, 20, OCTREE_SKIP_NONE, 0, &expected);
            octree_neighbor *found = ask(tree, there, 20, NULL, count);
            for (size_t j = 0; j < count; j++) {
                assert_true(found[j].point.id == expected[j].point.id);
                for (int axis = 0; axis < 3; axis++)
                    assert_true(found[j].point.position[axis] == expected[j].point.position[axis] * scales[s]);
            }
            free(found);
            free(expected);
        }
        brute_free(&whole);
        brute_free(&scaled);
        octree_destroy(tree);
    }
}

static void a_target_far_outside_still_sees_the_order(void **state)
{
    (void)state;
    static const double far[] = {1e17, 1e155, 1e300, DBL_MAX};
    octree *tree = make_tree(cube(-32, 32), 2, 21, OCTREE_GROW);
    for (int x = -32; x <= 32; x++)
        assert_int_equal(octree_insert(tree, (double[3]){x, 0, 0}, (uint64_t)(x + 32)), OCTREE_OK);
    for (size_t f = 0; f < sizeof far / sizeof far[0]; f++)
        for (int axis = 0; axis < 2; axis++) {
            double target[3] = {0};
            target[axis] = far[f];
            octree_neighbor *found = ask(tree, target, 65, NULL, 65);
            for (int i = 0; i < 65; i++) {
                /* Towards x the largest first; towards y the squares are far^2 + x^2: 0, -1, 1, -2, 2 ... */
                int x = axis == 0 ? 32 - i : i % 2 == 0 ? i / 2 : -(i / 2) - 1;
                assert_true(found[i].point.position[0] == x);
                assert_true(fabs(found[i].distance - far[f]) <= 32);
            }
            free(found);
        }
    octree_destroy(tree);
}

/* Lattice points of tenths with ids that repeat, and mirrored pairs that rounding cannot tell apart. */
static void fill_with_near_ties(brute *all, const double target[3])
{
    uint64_t random = 9;
    for (int i = 0; i < 64; i++)
        brute_insert(all, (double[3]){i % 4 * 0.1, i / 4 % 4 * 0.1, i / 16 * 0.1}, (uint64_t)i % 40);
    for (uint64_t i = 0; i < 40; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++) {
            at[axis] = target[axis] + (random_below(&random, 2) == 0 ? 0.3 : -0.3) / (double)(axis + 1);
            at[axis] = random_below(&random, 2) == 0 ? next_up(at[axis]) : at[axis];
        }
        if (!brute_contains(all, at, i % 10))
            brute_insert(all, at, i % 10);
    }
}

static void assert_same_answers(const octree *a, const octree *b, const double target[3])
{
    static const size_t asked[] = {1, 7, 40, SIZE_MAX};
    for (int i = 0; i < 4; i++) {
        const octree_search how = {.skip = (octree_skip)(i % 3), .skip_id = 3};
        octree_neighbor expected[128], found[128];
        size_t count, found_count;
        assert_int_equal(octree_nearest_k(a, target, asked[i], &how, expected, &count), OCTREE_OK);
        assert_int_equal(octree_nearest_k(b, target, asked[i], &how, found, &found_count), OCTREE_OK);
        assert_int_equal(found_count, count);
        for (size_t j = 0; j < count; j++)
            assert_true(same_neighbor(&found[j], &expected[j]));
    }
}

static void assert_shape_does_not_matter(const octree *one_leaf, const brute *all, size_t capacity, size_t depth)
{
    static const double targets[][3] = {{0.45, 0.55, 0.35}, {0.15, 0.15, 0.15}, {0.1, 0.2, 0.3}, {-3, 1e300, 0.2}};
    octree *tree = brute_tree(all, cube(-1, 1), capacity, depth);
    for (size_t i = 0; i < sizeof targets / sizeof targets[0]; i++)
        assert_same_answers(one_leaf, tree, targets[i]);
    octree_destroy(tree);
}

static void capacity_and_depth_never_change_an_answer(void **state)
{
    (void)state;
    brute all = {0};
    fill_with_near_ties(&all, (double[3]){0.45, 0.55, 0.35});
    assert_true(all.count > 90 && all.count <= 128);
    octree *one_leaf = brute_tree(&all, cube(-1, 1), all.count, 0);
    for (size_t capacity = 1; capacity <= 64; capacity++)
        assert_shape_does_not_matter(one_leaf, &all, capacity, OCTREE_MAX_DEPTH);
    for (size_t depth = 0; depth <= OCTREE_MAX_DEPTH; depth++)
        for (size_t capacity = 1; capacity <= 9; capacity += 4)
            assert_shape_does_not_matter(one_leaf, &all, capacity, depth);
    octree_destroy(one_leaf);
    brute_free(&all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_k_refuses_invalid_arguments),
        cmocka_unit_test(k_is_cut_to_the_points_that_count),
        cmocka_unit_test(an_empty_tree_has_no_neighbors),
        cmocka_unit_test(equal_distances_are_in_order_of_id_then_position),
        cmocka_unit_test(many_ids_at_one_position_come_lowest_first),
        cmocka_unit_test(a_skipped_id_is_left_out_wherever_it_is_stored),
        cmocka_unit_test(nearest_k_agrees_with_a_scan),
        cmocka_unit_test(one_neighbor_is_the_nearest),
        cmocka_unit_test(the_order_is_the_true_one_where_squares_overflow_or_vanish),
        cmocka_unit_test(a_target_far_outside_still_sees_the_order),
        cmocka_unit_test(capacity_and_depth_never_change_an_answer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
