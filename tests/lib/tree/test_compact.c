/* SPDX-License-Identifier: MIT */
/* test_compact.c - octree_compact() keeps nodes and points and needs no more memory than a new tree. */
#include "fixture.h"

#include "brute.h"
#include "counting_allocator.h"

enum { COUNT = 4000 };

static size_t memory_of(const octree *tree)
{
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    return stats.memory;
}

/* A tree in which points came one by one, and from which three of four were removed again. */
static octree *churned_tree(brute *left, counting_allocator *counts, octree_full_leaf full_leaf)
{
    const octree_box world = cube(-1, 1);
    octree *tree = make_counted_tree(counts, world, 6, 21, full_leaf);
    brute_sample(left, OCTREE_SAMPLE_CLUSTERED, 7, &world, COUNT);
    for (size_t i = 0; i < COUNT; i++)
        assert_int_equal(octree_insert(tree, left->points[i].position, left->points[i].id), OCTREE_OK);
    for (size_t i = COUNT; i-- > COUNT / 4;) {
        const octree_point gone = left->points[i];
        assert_int_equal(octree_remove(tree, gone.position, gone.id), OCTREE_OK);
        brute_remove(left, gone.position, gone.id);
    }
    return tree;
}

static void compact_keeps_the_nodes_and_uses_the_memory_of_a_new_tree(void **state)
{
    (void)state;
    for (int full_leaf = OCTREE_REFUSE; full_leaf <= OCTREE_GROW; full_leaf++) {
        brute left = {0};
        counting_allocator counts = {0}, fresh_counts = {0};
        octree *tree = churned_tree(&left, &counts, (octree_full_leaf)full_leaf);
        octree *fresh = make_counted_tree(&fresh_counts, cube(-1, 1), 6, 21, (octree_full_leaf)full_leaf);
        assert_int_equal(octree_insert_many(fresh, left.points, left.count, NULL, NULL), OCTREE_OK);
        const uint64_t digest = octree_digest(tree);
        const size_t before = memory_of(tree);
        assert_int_equal(octree_compact(tree), OCTREE_OK);
        assert_valid(tree);
        assert_true(octree_digest(tree) == digest && octree_digest(fresh) == digest);
        assert_int_equal(memory_of(tree), memory_of(fresh));
        assert_int_equal(counts.bytes, memory_of(tree));
        assert_true(memory_of(tree) < before / 2);
        octree_destroy(tree);
        octree_destroy(fresh);
        assert_all_returned(&counts);
        brute_free(&left);
    }
}

static void compact_without_memory_changes_nothing(void **state)
{
    (void)state;
    brute left = {0};
    counting_allocator counts = {0};
    octree *tree = churned_tree(&left, &counts, OCTREE_GROW);
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    octree_status status = OCTREE_NO_MEMORY;
    size_t failed = 0;
    for (; status == OCTREE_NO_MEMORY; failed++) {
        const size_t bytes = counts.bytes;
        counting_allocator_fail_at(&counts, failed);
        status = octree_compact(tree);
        counting_allocator_stop_failing(&counts);
        if (status == OCTREE_NO_MEMORY)
            assert_true(counts.bytes == bytes && octree_digest(tree) == digest && octree_version(tree) == version);
    }
    assert_int_equal(status, OCTREE_OK);
    assert_true(failed > 5 && octree_digest(tree) == digest);
    octree_destroy(tree);
    assert_all_returned(&counts);
    brute_free(&left);
}

static void an_empty_tree_and_none_are_no_trouble(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 6, 21, OCTREE_REFUSE);
    assert_int_equal(octree_compact(tree), OCTREE_OK);
    assert_int_equal(octree_count(tree), 0);
    assert_valid(tree);
    assert_int_equal(octree_compact(NULL), OCTREE_NULL_ARGUMENT);
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(compact_keeps_the_nodes_and_uses_the_memory_of_a_new_tree),
        cmocka_unit_test(compact_without_memory_changes_nothing),
        cmocka_unit_test(an_empty_tree_and_none_are_no_trouble),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
