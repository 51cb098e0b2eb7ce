/* SPDX-License-Identifier: MIT */
/* test_tune.c - octree_tune() changes the leaf capacity and the nodes, never an answer. */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "brute.h"
#include "counting_allocator.h"

enum { COUNT = 6000 };

static const octree_mix finds = {.changes = 1}, large_ranges = {.ranges = 1, .hits = 1000},
                        many_neighbors = {.nearest = 1, .k = 500};

static size_t capacity_of(const octree *tree)
{
    return octree_definition(tree).leaf_capacity;
}

static void tune(octree *tree, const octree_mix *mix)
{
    assert_int_equal(octree_tune(tree, mix), OCTREE_OK);
    assert_valid(tree);
}

/* The test fails unless the tree holds these points in the nodes of one built with its capacity. */
static void assert_as_built(const octree *tree, const brute *all)
{
    const octree_def def = octree_definition(tree);
    octree *other = brute_tree(all, def.world, def.leaf_capacity, def.max_depth);
    assert_true(octree_digest(tree) == octree_digest(other));
    octree_destroy(other);
}

static void a_tuned_tree_is_one_built_with_the_capacity_it_reports(void **state)
{
    (void)state;
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++) {
        brute all = {0};
        const octree_box world = cube(-1, 1);
        brute_sample(&all, (octree_sample_kind)kind, 2, &world, COUNT);
        octree *tree = brute_tree(&all, world, 1, 21);
        const octree_mix *mixes[] = {NULL, &finds, &large_ranges};
        for (int i = 0; i < 3; i++) {
            tune(tree, mixes[i]);
            const size_t capacity = capacity_of(tree);
            assert_true(capacity >= 4 && capacity <= 256 && (capacity & (capacity - 1)) == 0);
            assert_as_built(tree, &all);
        }
        octree_destroy(tree);
        brute_free(&all);
    }
}

static void large_ranges_and_many_neighbors_want_larger_leaves_than_finds(void **state)
{
    (void)state;
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++) {
        brute all = {0};
        const octree_box world = cube(-1, 1);
        brute_sample(&all, (octree_sample_kind)kind, 3, &world, COUNT);
        octree *tree = brute_tree(&all, world, 16, 21);
        tune(tree, &finds);
        const size_t small = capacity_of(tree);
        tune(tree, &large_ranges);
        assert_true(capacity_of(tree) > small);
        tune(tree, &many_neighbors);
        assert_true(capacity_of(tree) > small);
        octree_destroy(tree);
        brute_free(&all);
    }
}

static void the_choice_depends_on_neither_order_nor_the_capacity_before(void **state)
{
    (void)state;
    brute all = {0}, reversed = {0};
    const octree_box world = cube(-1, 1);
    brute_sample(&all, OCTREE_SAMPLE_UNIFORM, 5, &world, COUNT);
    for (size_t i = all.count; i-- > 0;)
        brute_collect(&all.points[i], &reversed);
    octree *tree = brute_tree(&all, world, 2, 21), *other = brute_tree(&reversed, world, 200, 21);
    tune(tree, NULL);
    tune(other, NULL);
    assert_true(octree_digest(tree) == octree_digest(other));
    octree_destroy(tree);
    octree_destroy(other);
    brute_free(&all);
    brute_free(&reversed);
}

static void the_scale_of_a_mix_does_not_count(void **state)
{
    (void)state;
    brute all = {0};
    const octree_box world = cube(-1, 1);
    brute_sample(&all, OCTREE_SAMPLE_CLUSTERED, 5, &world, COUNT);
    octree *tree = brute_tree(&all, world, 16, 21);
    tune(tree, &(octree_mix){2, 1, 8, 3, 20});
    const size_t chosen = capacity_of(tree);
    static const double scales[] = {0x1p-1000, 0x1p-3, 0x1p1021};
    for (int i = 0; i < 3; i++) {
        tune(tree, &(octree_mix){2 * scales[i], scales[i], 8, 3 * scales[i], 20});
        assert_int_equal(capacity_of(tree), chosen);
    }
    octree_destroy(tree);
    brute_free(&all);
}

static void an_invalid_mix_is_refused_and_changes_nothing(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 3, 21, OCTREE_GROW), *refusing = make_tree(cube(-1, 1), 3, 21, OCTREE_REFUSE);
    insert_all(tree, (const double[][3]){{0.1, 0.2, 0.3}, {-0.1, -0.2, -0.3}}, 2);
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    static const struct {
        octree_mix mix;
        octree_status expected;
    } rows[] = {
        {{0, 0, 1, 0, 10}, OCTREE_BAD_SIZE},           {{-1, 1, 1, 1, 10}, OCTREE_BAD_SIZE},
        {{1, -1, 1, 1, 10}, OCTREE_BAD_SIZE},          {{1, 1, 1, -DBL_MIN, 10}, OCTREE_BAD_SIZE},
        {{NAN, 1, 1, 1, 10}, OCTREE_NOT_FINITE},       {{1, INFINITY, 1, 1, 10}, OCTREE_NOT_FINITE},
        {{1, 1, 1, -INFINITY, 10}, OCTREE_NOT_FINITE},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_int_equal(octree_tune(tree, &rows[i].mix), rows[i].expected);
    assert_int_equal(octree_tune(NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_tune(refusing, NULL), OCTREE_BAD_CAPACITY);
    octree *none = tree;
    octree_def def = octree_def_default();
    def.leaf_capacity = OCTREE_AUTO;
    def.full_leaf = OCTREE_REFUSE;
    assert_int_equal(octree_create(&def, &none), OCTREE_BAD_CAPACITY);
    assert_null(none);
    assert_true(octree_digest(tree) == digest && octree_version(tree) == version);
    octree_destroy(tree);
    octree_destroy(refusing);
}

static void trees_of_any_size_and_world_can_be_tuned(void **state)
{
    (void)state;
    static const double worlds[][2] = {{-1, 1}, {-DBL_MAX, DBL_MAX}, {5e-324, 1e-310}, {1e15, 1e15 + 1}};
    for (size_t i = 0; i < sizeof worlds / sizeof worlds[0]; i++)
        for (size_t count = 0; count <= 300; count = 3 * count + 1) {
            octree *tree = make_tree(cube(worlds[i][0], worlds[i][1]), 2, 21, OCTREE_GROW);
            uint64_t random = 8;
            for (uint64_t id = 0; id < count; id++) {
                double at[3];
                for (int axis = 0; axis < 3; axis++)
                    at[axis] = random_between(&random, worlds[i][0], worlds[i][1]);
                assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
            }
            tune(tree, NULL);
            tune(tree, &(octree_mix){1, 1, SIZE_MAX, 1, SIZE_MAX});
            tune(tree, &(octree_mix){1, 1, 0, 1, 0});
            assert_int_equal(octree_count(tree), count);
            octree_destroy(tree);
        }
}

static void few_points_and_tiny_shares_give_a_capacity_in_range(void **state)
{
    (void)state;
    static const octree_mix mixes[] = {
        {1, 1, 1, 1, 10}, {5e-324, 0, 1, 0, 0}, {0, 1e-323, 1, 5e-324, 10}, {DBL_MAX, DBL_MAX, 1, DBL_MAX, 10}};
    static const size_t capacities[] = {1, 3, 1000};
    for (size_t count = 0; count < 3; count++)
        for (size_t c = 0; c < 3; c++)
            for (size_t m = 0; m < sizeof mixes / sizeof mixes[0]; m++) {
                octree *tree = make_tree(cube(-1, 1), capacities[c], 21, OCTREE_GROW);
                insert_all(tree, (const double[][3]){{0.1, 0.2, 0.3}, {-0.1, -0.2, -0.3}}, count);
                tune(tree, &mixes[m]);
                assert_true(capacity_of(tree) >= 4 && capacity_of(tree) <= 256);
                assert_true(count > 0 || capacity_of(tree) == 64);
                octree_destroy(tree);
            }
}

static void equal_points_can_be_tuned(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 2, 21, OCTREE_GROW);
    const double at[3] = {0.5, 0.25, -0.125};
    for (uint64_t id = 0; id < 100000; id++)
        octree_insert(tree, at, id);
    tune(tree, NULL);
    assert_int_equal(octree_count(tree), 100000);
    octree_destroy(tree);
}

static void an_automatic_tree_is_tuned_as_it_grows(void **state)
{
    (void)state;
    const octree_box world = cube(-1, 1);
    brute all = {0};
    brute_sample(&all, OCTREE_SAMPLE_UNIFORM, 9, &world, COUNT);
    octree *one_by_one = make_tree(world, OCTREE_AUTO, 21, OCTREE_GROW), *tuned = make_tree(world, 7, 21, OCTREE_GROW);
    const size_t before = capacity_of(one_by_one);
    for (size_t i = 0; i < all.count; i++) {
        assert_int_equal(octree_insert(one_by_one, all.points[i].position, all.points[i].id), OCTREE_OK);
        octree_insert(tuned, all.points[i].position, all.points[i].id);
        const size_t count = i + 1;
        if (count >= 1024 && (count & (count - 1)) == 0) {
            tune(tuned, NULL);
            assert_int_equal(capacity_of(one_by_one), capacity_of(tuned));
        } else if (count < 1024) {
            assert_int_equal(capacity_of(one_by_one), before);
        }
    }
    assert_as_built(one_by_one, &all);
    octree_destroy(one_by_one);
    octree_destroy(tuned);
    brute_free(&all);
}

static void an_automatic_tree_is_tuned_when_it_is_built_and_keeps_to_its_last_mix(void **state)
{
    (void)state;
    const octree_box world = cube(-1, 1), wider = cube(-2, 2);
    brute all = {0};
    brute_sample(&all, OCTREE_SAMPLE_UNIFORM, 9, &world, 2 * COUNT);
    octree *tree = make_tree(world, OCTREE_AUTO, 21, OCTREE_GROW), *other = make_tree(world, 64, 21, OCTREE_GROW);
    assert_int_equal(octree_insert_many(tree, all.points, COUNT, NULL, NULL), OCTREE_OK);
    octree_insert_many(other, all.points, COUNT, NULL, NULL);
    tune(other, NULL);
    assert_int_equal(capacity_of(tree), capacity_of(other));
    tune(tree, &large_ranges);
    assert_int_equal(octree_reworld(tree, &wider), OCTREE_OK);
    octree_insert_many(tree, all.points + COUNT, COUNT, NULL, NULL);
    assert_int_equal(octree_reworld(other, &wider), OCTREE_OK);
    octree_insert_many(other, all.points + COUNT, COUNT, NULL, NULL);
    tune(other, &large_ranges);
    assert_int_equal(capacity_of(tree), capacity_of(other));
    assert_true(octree_digest(tree) == octree_digest(other));
    octree_destroy(tree);
    octree_destroy(other);
    brute_free(&all);
}

static void the_default_mix_is_the_documented_one(void **state)
{
    (void)state;
    const octree_mix mix = octree_mix_default();
    assert_true(mix.changes == 1 && mix.nearest == 1 && mix.k == 1 && mix.ranges == 1 && mix.hits == 10);
}

/* Of more points than are looked at, some cells are left out; and the mix may name one thing alone. */
static void a_large_tree_is_tuned_by_a_sample(void **state)
{
    (void)state;
    enum { LARGE = 80000 };
    const octree_box world = cube(-1, 1);
    brute all = {0};
    brute_sample(&all, OCTREE_SAMPLE_UNIFORM, 9, &world, LARGE);
    octree *tree = make_tree(world, 4, 21, OCTREE_GROW);
    assert_int_equal(octree_insert_many(tree, all.points, LARGE, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_tune(tree, &(octree_mix){.ranges = 1, .hits = 10}), OCTREE_OK);
    assert_int_equal(octree_tune(tree, &(octree_mix){.nearest = 1, .k = 1}), OCTREE_OK);
    assert_int_equal(octree_count(tree), LARGE);
    assert_valid(tree);
    octree_destroy(tree);
    brute_free(&all);
}

static void without_memory_the_tree_stays_as_it_was(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 3, 21, OCTREE_GROW);
    uint64_t random = 4;
    for (uint64_t id = 0; id < 1500; id++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = random_between(&random, -1, 1);
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
    }
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    octree_status status = OCTREE_NO_MEMORY;
    size_t failed = 0;
    for (; status == OCTREE_NO_MEMORY; failed++) {
        const size_t bytes = counts.bytes;
        counting_allocator_fail_at(&counts, failed);
        status = octree_tune(tree, NULL);
        counting_allocator_stop_failing(&counts);
        assert_valid(tree);
        if (status == OCTREE_NO_MEMORY)
            assert_true(counts.bytes == bytes && octree_digest(tree) == digest && octree_version(tree) == version);
    }
    assert_int_equal(status, OCTREE_OK);
    assert_true(failed > 10 && octree_version(tree) > version);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static void an_insertion_succeeds_though_there_is_no_memory_to_tune(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), OCTREE_AUTO, 21, OCTREE_GROW);
    const octree_box world = cube(-1, 1);
    brute all = {0};
    brute_sample(&all, OCTREE_SAMPLE_UNIFORM, 9, &world, 1024);
    for (size_t i = 0; i < 1023; i++)
        assert_int_equal(octree_insert(tree, all.points[i].position, all.points[i].id), OCTREE_OK);
    counting_allocator_fail_at(&counts, 2); /* the insertion itself takes two blocks at most */
    assert_int_equal(octree_insert(tree, all.points[1023].position, all.points[1023].id), OCTREE_OK);
    counting_allocator_stop_failing(&counts);
    assert_int_equal(octree_count(tree), 1024);
    assert_valid(tree);
    octree_destroy(tree);
    assert_all_returned(&counts);
    brute_free(&all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tuned_tree_is_one_built_with_the_capacity_it_reports),
        cmocka_unit_test(large_ranges_and_many_neighbors_want_larger_leaves_than_finds),
        cmocka_unit_test(the_choice_depends_on_neither_order_nor_the_capacity_before),
        cmocka_unit_test(the_scale_of_a_mix_does_not_count),
        cmocka_unit_test(an_invalid_mix_is_refused_and_changes_nothing),
        cmocka_unit_test(trees_of_any_size_and_world_can_be_tuned),
        cmocka_unit_test(few_points_and_tiny_shares_give_a_capacity_in_range),
        cmocka_unit_test(equal_points_can_be_tuned),
        cmocka_unit_test(an_automatic_tree_is_tuned_as_it_grows),
        cmocka_unit_test(an_automatic_tree_is_tuned_when_it_is_built_and_keeps_to_its_last_mix),
        cmocka_unit_test(the_default_mix_is_the_documented_one),
        cmocka_unit_test(a_large_tree_is_tuned_by_a_sample),
        cmocka_unit_test(without_memory_the_tree_stays_as_it_was),
        cmocka_unit_test(an_insertion_succeeds_though_there_is_no_memory_to_tune),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
