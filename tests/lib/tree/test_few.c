/* SPDX-License-Identifier: MIT */
/* test_few.c - small batches in a large tree equal single changes. */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "brute.h"
#include "counting_allocator.h"

enum { COUNT = 3000, FEW = 350 };

static octree_point points[COUNT], few[FEW];

/* `few` are those in a slab of the world that cuts through cells, so that leaves are emptied and nodes merge, and what
 * is needed of others. Some are not stored, or outside the world. */
static void draw(octree_sample_kind kind, bool errs)
{
    brute all = {0};
    const octree_box world = cube(-1, 1);
    brute_sample(&all, kind, 7, &world, COUNT);
    memcpy(points, all.points, sizeof points);
    brute_free(&all);
    for (size_t i = 0; i < COUNT; i++)
        points[i].id = 2 * i + 1;
    for (size_t i = 0; i < 60; i++) /* of one place: a leaf that is hashed under GROW */
        for (int axis = 0; axis < 3; axis++)
            points[900 + 2 * i].position[axis] = 0.7;
    size_t drawn = 0;
    for (int others = 0; others < 2; others++)
        for (size_t i = 0; i < COUNT && drawn < FEW; i++)
            if ((points[i].position[0] > -0.78) == others)
                few[drawn++] = points[i];
    for (size_t i = 0; i < FEW; i++) {
        if (errs && i % 20 == 4)
            few[i].id++;
        if (errs && i % 20 == 14)
            few[i].position[i % 3] = i % 40 == 14 ? NAN : 2;
    }
}

static octree *begin(counting_allocator *counts, size_t capacity, octree_full_leaf full_leaf)
{
    octree *tree = make_counted_tree(counts, cube(-1, 1), capacity, 21, full_leaf);
    assert_int_equal(octree_insert_many(tree, points, COUNT, NULL, NULL), OCTREE_OK);
    return tree;
}

static void assert_alike(const octree *a, const octree *b)
{
    assert_int_equal(octree_count(a), octree_count(b));
    assert_true(octree_digest(a) == octree_digest(b));
    assert_valid(a);
}

/* Remove them and insert them again. */
static void assert_changed_alike(size_t capacity, octree_full_leaf full_leaf)
{
    counting_allocator counts = {0};
    octree *batched = begin(&counts, capacity, full_leaf), *stepped = begin(&counts, capacity, full_leaf);
    for (int inserts = 0; inserts < 2; inserts++) {
        octree_status statuses[FEW];
        size_t done, expected = 0;
        const uint64_t version = octree_version(batched);
        assert_int_equal((inserts ? octree_insert_many : octree_remove_many)(batched, few, FEW, statuses, &done),
                         OCTREE_OK);
        for (size_t i = 0; i < FEW; i++) {
            const octree_status status = (inserts ? octree_insert : octree_remove)(stepped, few[i].position, few[i].id);
            assert_int_equal(statuses[i], status);
            expected += status == OCTREE_OK;
        }
        assert_int_equal(done, expected);
        assert_true(octree_version(batched) != version);
        assert_alike(batched, stepped);
    }
    octree_destroy(batched);
    octree_destroy(stepped);
    assert_all_returned(&counts);
}

static void few_changes_equal_single_changes(void **state)
{
    (void)state;
    static const size_t capacities[] = {1, 3, 8, 64, 200};
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++)
        for (int errs = 0; errs < 2; errs++) {
            draw((octree_sample_kind)kind, errs);
            for (size_t c = 0; c < sizeof capacities / sizeof capacities[0]; c++) {
                assert_changed_alike(capacities[c], OCTREE_GROW);
                assert_changed_alike(capacities[c], OCTREE_REFUSE);
            }
        }
}

/* The first of two adds a leaf beside the leaf of the second. */
static void a_leaf_that_is_added_moves_its_siblings(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 8, 21, OCTREE_GROW);
    uint64_t random = 1;
    for (uint64_t id = 0; id < 100; id++) {
        const double at = -1 + (double)random_below(&random, 1000) / 2000;
        assert_int_equal(octree_insert(tree, (double[]){at, -0.5, at}, id), OCTREE_OK);
    }
    assert_int_equal(octree_insert(tree, (double[]){-0.5, -0.5, 0.5}, 100), OCTREE_OK);
    const octree_point two[] = {{{0.5, 0.5, 0.5}, 101}, {{-0.5, -0.5, 0.6}, 102}};
    size_t done;
    assert_int_equal(octree_insert_many(tree, two, 2, NULL, &done), OCTREE_OK);
    assert_int_equal(done, 2);
    assert_valid(tree);
    assert_true(octree_contains(tree, two[1].position, 102));
    octree_destroy(tree);
}

/* The second of two that are the same is not there any more. */
static void a_pair_that_comes_twice_is_removed_once(void **state)
{
    (void)state;
    draw(OCTREE_SAMPLE_UNIFORM, false);
    few[300] = few[20];
    assert_changed_alike(8, OCTREE_GROW);
}

/* That removes nothing is not a change. */
static void removing_absent_points_keeps_the_version(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    draw(OCTREE_SAMPLE_UNIFORM, false);
    octree *tree = begin(&counts, 8, OCTREE_GROW);
    const uint64_t version = octree_version(tree), digest = octree_digest(tree);
    for (size_t i = 0; i < FEW; i++)
        few[i].id = 2 * i;
    size_t done;
    assert_int_equal(octree_remove_many(tree, few, FEW, NULL, &done), OCTREE_OK);
    assert_int_equal(done, 0);
    assert_true(octree_version(tree) == version && octree_digest(tree) == digest);
    octree_destroy(tree);
}

static void few_removals_survive_the_failure_of_each_allocation(void **state)
{
    (void)state;
    draw(OCTREE_SAMPLE_UNIFORM, true);
    size_t failures = 0;
    for (bool failed = true; failed; failures += failed) {
        counting_allocator counts = {0};
        octree *tree = begin(&counts, 3, OCTREE_GROW);
        const uint64_t digest = octree_digest(tree), version = octree_version(tree);
        size_t bytes = 0;
        for (int again = 0; failed && again < 200; again++) { /* failures do not add up */
            counting_allocator_fail_at(&counts, failures);
            counts.fail_until = SIZE_MAX;
            failed = octree_remove_many(tree, few, FEW, NULL, NULL) == OCTREE_NO_MEMORY;
            counting_allocator_stop_failing(&counts);
            bytes = again == 0 ? counts.bytes : bytes;
            assert_true(!failed || counts.bytes == bytes);
        }
        assert_valid(tree);
        assert_true((octree_digest(tree) == digest && octree_version(tree) == version) == failed);
        octree_remove_many(tree, few, FEW, NULL, NULL); /* with memory as if nothing had been */
        assert_valid(tree);
        octree_destroy(tree);
        assert_all_returned(&counts);
    }
    assert_true(failures > 2); /* one while leaves to merge into were planned */
}

/* Also of the leaves that nodes become. */
static void each_allocation_of_many_removals_may_fail(void **state)
{
    (void)state;
    enum { ALL = 6000, FEW = 40 };
    for (size_t capacity = 4; capacity <= 64; capacity *= 2) {
        counting_allocator counts = {0};
        const octree_box world = cube(-1, 1);
        brute all = {0};
        octree *tree = make_counted_tree(&counts, world, capacity, 21, OCTREE_GROW);
        brute_sample(&all, OCTREE_SAMPLE_UNIFORM, capacity, &world, ALL);
        assert_int_equal(octree_insert_many(tree, all.points, ALL, NULL, NULL), OCTREE_OK);
        for (size_t from = 0; from + 20 * FEW < ALL; from += FEW) {
            octree_status status = OCTREE_NO_MEMORY;
            for (size_t failing = 0; status == OCTREE_NO_MEMORY; failing++) {
                size_t removed = 0;
                counting_allocator_fail_at(&counts, failing);
                status = octree_remove_many(tree, all.points + from, FEW, NULL, &removed);
                counting_allocator_stop_failing(&counts);
                assert_int_equal(removed, status == OCTREE_OK ? FEW : 0);
                assert_int_equal(octree_count(tree), ALL - from - removed);
            }
            if (from % (8 * FEW) == 0)
                assert_valid(tree);
        }
        assert_valid(tree);
        octree_destroy(tree);
        assert_all_returned(&counts);
        brute_free(&all);
    }
}

typedef struct choice {
    octree_node leaf;
    uint64_t random;
    unsigned met;
} choice;

/* Each leaf is as likely. */
static octree_walk_order choose(const octree_node *node, void *context)
{
    choice *c = context;
    if (node->leaf && node->count && random_below(&c->random, ++c->met) == 0)
        c->leaf = *node;
    return OCTREE_WALK_ON;
}

/* Let a batch of the first points of a leaf, as the tree itself has them, do what copies of them do one by one. */
static void change_a_leaf(octree *batched, octree *stepped, uint64_t *random, int what)
{
    static octree_point copies[COUNT];
    static double to[COUNT][3];
    choice c = {.random = *random};
    assert_int_equal(octree_walk(batched, choose, &c), OCTREE_OK);
    *random = c.random;
    const size_t count = 1 + random_below(random, c.leaf.count);
    memcpy(copies, c.leaf.points, count * sizeof *copies);
    for (size_t i = 0; i < count; i++) {
        const octree_point *p = &copies[i];
        memcpy(to[i], (double[3]){-p->position[0], p->position[2], p->position[1]}, sizeof to[i]);
        if (what == OCTREE_INSERTED)
            octree_insert(stepped, p->position, p->id);
        else if (what == OCTREE_REMOVED)
            octree_remove(stepped, p->position, p->id);
        else
            octree_move(stepped, p->position, p->id, to[i]);
    }
    const octree_status status =
        what == OCTREE_INSERTED  ? octree_insert_many(batched, c.leaf.points, count, NULL, NULL)
        : what == OCTREE_REMOVED ? octree_remove_many(batched, c.leaf.points, count, NULL, NULL)
                                 : octree_move_many(batched, c.leaf.points, (const double(*)[3])to, count, NULL, NULL);
    assert_int_equal(status, OCTREE_OK);
    assert_alike(batched, stepped);
}

static void the_points_of_a_leaf_are_given_as_they_are(void **state)
{
    (void)state;
    static const size_t capacities[] = {3, 20, 64, 200}, sizes[] = {60, 300, COUNT};
    uint64_t random = 1;
    draw(OCTREE_SAMPLE_CLUSTERED, false);
    for (int i = 0; i < 24; i++) {
        octree *trees[2];
        for (int k = 0; k < 2; k++) {
            trees[k] = make_tree(cube(-1, 1), capacities[i % 4], 21, i / 4 % 2 ? OCTREE_GROW : OCTREE_REFUSE);
            assert_int_equal(octree_insert_many(trees[k], points, sizes[i % 3], NULL, NULL), OCTREE_OK);
        }
        for (int change = 0; change < 40 && octree_count(trees[0]) > 0; change++)
            change_a_leaf(trees[0], trees[1], &random, change % 3);
        octree_destroy(trees[0]);
        octree_destroy(trees[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_allocation_of_many_removals_may_fail),
        cmocka_unit_test(few_changes_equal_single_changes),
        cmocka_unit_test(a_leaf_that_is_added_moves_its_siblings),
        cmocka_unit_test(a_pair_that_comes_twice_is_removed_once),
        cmocka_unit_test(removing_absent_points_keeps_the_version),
        cmocka_unit_test(few_removals_survive_the_failure_of_each_allocation),
        cmocka_unit_test(the_points_of_a_leaf_are_given_as_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
