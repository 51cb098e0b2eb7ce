/* SPDX-License-Identifier: MIT */
/* test_executor.c - nodes, statuses, answers, digests and memory are the same for any number of threads and any order
 * of tasks. The library's sources once more, which divide work at a few points; and again with ThreadSanitizer.
 */
#include "tree.h"

#include "broken_tree.h"
#include "counting_allocator.h"
#include "executors.h"
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

#include "octree/sample.h"

enum { POINTS = 2500, STEPS = 6 };

static octree *make(octree_full_leaf full_leaf, size_t capacity, octree_executor executor, counting_allocator *counts)
{
    octree_def def = define(cube(-1000, 1000), capacity, capacity == 3 ? 6 : OCTREE_MAX_DEPTH, full_leaf);
    def.executor = executor;
    if (counts)
        def.allocator = counting_allocator_use(counts);
    octree *tree = NULL;
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    return tree;
}

/* Points of which some are equal, some are outside, and where a few of them move to. */
typedef struct script {
    octree_point points[POINTS];
    double to[POINTS][3];
} script;

static void write_script(script *s, octree_sample_kind kind)
{
    static double positions[POINTS][3];
    const octree_box world = cube(-1000, 1000);
    uint64_t random = 4;
    assert_int_equal(octree_sample(kind, 5, &world, POINTS, positions), OCTREE_OK);
    for (size_t i = 0; i < POINTS; i++) {
        s->points[i].id = i % 50 == 7 ? 3 : i;
        memcpy(s->points[i].position, positions[i % 40 == 3 ? 3 : i], sizeof positions[i]);
        if (i % 300 == 299)
            s->points[i].position[2] = 1e9;
        for (int axis = 0; axis < 3; axis++)
            s->to[i][axis] = i % 90 == 5 ? 500 : s->points[i].position[axis] * 0.9 + random_between(&random, -20, 20);
    }
}

/* What a step says and leaves. */
typedef struct trace {
    uint64_t digest[STEPS];
    size_t done[STEPS];
    octree_status returned[STEPS];
    octree_status statuses[STEPS][POINTS];
    octree_neighbor neighbors[POINTS];
    bool found[POINTS];
    octree_cost cost;
} trace;

static octree_status take_step(octree *tree, const script *s, int step, octree_status *statuses, size_t *done)
{
    const double(*to)[3] = s->to;
    const size_t tenth = POINTS / 10;
    switch (step) {
    case 0:
        return octree_insert_many(tree, s->points, POINTS - tenth, statuses, done);
    case 1:
        return octree_insert_many(tree, s->points + tenth, POINTS - tenth, statuses, done);
    case 2:
        return octree_move_many(tree, s->points, to, tenth, statuses, done);
    case 3:
        return octree_remove_many(tree, s->points, POINTS / 2, statuses, done);
    case 4:
        return octree_move_many(tree, s->points, to, POINTS, statuses, done);
    default:
        return octree_insert_many(tree, s->points, POINTS, statuses, done);
    }
}

static void play(octree *tree, const script *s, trace *t)
{
    memset(t, 0, sizeof *t);
    for (int step = 0; step < STEPS; step++) {
        t->returned[step] = take_step(tree, s, step, t->statuses[step], &t->done[step]);
        t->digest[step] = octree_digest(tree);
        assert_valid(tree);
    }
    const octree_search how = {.cost = &t->cost};
    assert_int_equal(octree_nearest_batch(tree, s->to, POINTS, &how, t->neighbors, t->found), OCTREE_OK);
}

static const struct {
    octree_full_leaf full_leaf;
    size_t capacity;
} trees[] = {{OCTREE_GROW, 4}, {OCTREE_REFUSE, 3}, {OCTREE_GROW, 64}, {OCTREE_REFUSE, 1}, {OCTREE_GROW, 3000}};
enum { TREES = sizeof trees / sizeof trees[0] };

static void assert_same_as_alone(octree_executor executor, octree_sample_kind kind, size_t tree_count)
{
    static script s;
    static trace alone, shared;
    write_script(&s, kind);
    for (size_t i = 0; i < tree_count; i++) {
        octree *one = make(trees[i].full_leaf, trees[i].capacity, (octree_executor){0}, NULL);
        octree *many = make(trees[i].full_leaf, trees[i].capacity, executor, NULL);
        play(one, &s, &alone);
        play(many, &s, &shared);
        assert_memory_equal(&alone, &shared, sizeof alone);
        assert_true(alone.done[0] > 10 && alone.done[3] > 10 && alone.done[4] > 10);
        octree_destroy(one);
        octree_destroy(many);
    }
}

static void any_order_of_tasks_does_the_same(void **state)
{
    (void)state;
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++)
        assert_same_as_alone(shuffled_executor(), (octree_sample_kind)kind, TREES);
}

static void any_number_of_threads_does_the_same(void **state)
{
    (void)state;
    static const unsigned counts[] = {1, 2, 7};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        test_threads threads = {.count = counts[i]};
        assert_same_as_alone(threads_executor(&threads), OCTREE_SAMPLE_CLUSTERED, 2);
        assert_true(threads.runs > 20);
    }
}

static void tasks_that_are_left_out_run_on_the_calling_thread(void **state)
{
    (void)state;
    test_threads threads = {.count = 2, .left_out = 3};
    assert_same_as_alone(threads_executor(&threads), OCTREE_SAMPLE_UNIFORM, TREES);
}

static void tasks_that_are_repeated_or_out_of_range_do_no_harm(void **state)
{
    (void)state;
    test_threads threads = {.count = 3, .careless = true};
    assert_same_as_alone(threads_executor(&threads), OCTREE_SAMPLE_UNIFORM, TREES);
}

static void threads_of_another_floating_point_mode_change_no_answer(void **state)
{
    (void)state;
    test_threads threads = {.count = 4, .odd_mode = true};
    assert_same_as_alone(threads_executor(&threads), OCTREE_SAMPLE_UNIFORM, TREES);
}

static size_t memory_when_built(octree_executor executor, const script *s)
{
    octree_stats stats;
    octree *tree = make(OCTREE_GROW, 16, executor, NULL);
    assert_int_equal(octree_insert_many(tree, s->points, POINTS, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    octree_destroy(tree);
    return stats.memory;
}

static void what_is_built_takes_the_same_memory_for_any_number_of_threads(void **state)
{
    (void)state;
    static script s;
    write_script(&s, OCTREE_SAMPLE_CLUSTERED);
    const size_t memory = memory_when_built(shuffled_executor(), &s);
    for (unsigned count = 1; count <= 7; count += 2) {
        test_threads threads = {.count = count};
        assert_int_equal(memory_when_built(threads_executor(&threads), &s), memory);
    }
}

static void the_first_broken_node_is_named_by_any_number_of_threads(void **state)
{
    (void)state;
    static script s;
    const double nowhere[3] = {999.5, -999.5, 999.5};
    write_script(&s, OCTREE_SAMPLE_UNIFORM);
    test_threads threads = {.count = 3};
    octree *trees_of[2] = {make(OCTREE_GROW, 4, (octree_executor){0}, NULL),
                           make(OCTREE_GROW, 4, threads_executor(&threads), NULL)};
    octree_address where[2];
    const char *said[2];
    for (int i = 0; i < 2; i++) {
        assert_int_equal(octree_insert_many(trees_of[i], s.points, POINTS, NULL, NULL), OCTREE_OK);
        break_tree(trees_of[i], s.points[1000].position, nowhere);
        break_tree(trees_of[i], s.points[20].position, nowhere);
        said[i] = octree_check(trees_of[i], &where[i]);
        assert_non_null(said[i]);
        for (size_t point = 0; point < 20; point++) /* in most threads' shares */
            break_tree(trees_of[i], s.points[50 * point + 25].position, nowhere);
        octree_address first;
        assert_non_null(octree_check(trees_of[i], &first));
        assert_true(first <= where[i] || octree_address_depth(first) != octree_address_depth(where[i]));
        trees_of[i]->root.count++;
        assert_string_equal(octree_check(trees_of[i], &first), "a node's count is not the sum of its children's");
        assert_true(first == OCTREE_ROOT);
        trees_of[i]->root.count--;
        node *large = child_at(&trees_of[i]->root, 7); /* which is broken above the leaves that are shared out */
        child_at(large, 7)->count++;
        assert_non_null(octree_check(trees_of[i], &first));
        assert_int_equal(octree_address_octant(first, 0), 0);
        child_at(large, 7)->count--;
        octree_destroy(trees_of[i]);
    }
    assert_string_equal(said[0], said[1]);
    assert_true(where[0] == where[1]);
}

static void a_leaf_takes_memory_for_its_points_and_has_a_limit(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make(OCTREE_GROW, 4, (octree_executor){0}, &counts);
    const size_t bytes = counts.bytes;
    node leaf;
    assert_true(leaf_create(&tree->store, &leaf, 0));
    assert_null(leaf.below);
    assert_false(leaf_create(&tree->store, &leaf, UINT32_MAX));
    assert_int_equal(counts.bytes, bytes);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

/* One of the steps with the n-th allocation failing. False when it needed fewer. */
static bool fails_without_a_trace(const script *s, size_t i, int failing, size_t n, const trace *expected)
{
    static octree_status statuses[POINTS];
    counting_allocator counts = {0};
    octree *tree = make(trees[i].full_leaf, trees[i].capacity, shuffled_executor(), &counts);
    for (int step = 0; step < failing; step++)
        assert_int_equal(take_step(tree, s, step, statuses, NULL), OCTREE_OK);
    const uint64_t before = octree_digest(tree), version = octree_version(tree);
    counting_allocator_fail_at(&counts, n);
    const octree_status status = take_step(tree, s, failing, statuses, NULL);
    const bool failed = counts.calls > counts.fail_from;
    counting_allocator_stop_failing(&counts);
    assert_true(status == OCTREE_OK || (failed && status == OCTREE_NO_MEMORY));
    if (status == OCTREE_NO_MEMORY)
        assert_true(octree_digest(tree) == before && octree_version(tree) == version);
    assert_valid(tree);
    if (status == OCTREE_NO_MEMORY)
        assert_int_equal(take_step(tree, s, failing, statuses, NULL), OCTREE_OK);
    assert_true(octree_digest(tree) == expected->digest[failing]);
    octree_destroy(tree);
    assert_all_returned(&counts);
    return failed;
}

static void tasks_survive_the_failure_of_each_allocation(void **state)
{
    (void)state;
    static script s;
    static trace expected;
    write_script(&s, OCTREE_SAMPLE_CLUSTERED);
    for (size_t i = 0; i < 2; i++) {
        octree *tree = make(trees[i].full_leaf, trees[i].capacity, (octree_executor){0}, NULL);
        play(tree, &s, &expected);
        octree_destroy(tree);
        for (int step = 0; step < STEPS - 1; step++)
            for (size_t n = 0; fails_without_a_trace(&s, i, step, n, &expected); n += 1 + n / 8)
                ;
    }
}

/* The argument may be a pattern of names. */
int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_threads_does_the_same),
        cmocka_unit_test(the_first_broken_node_is_named_by_any_number_of_threads),
        cmocka_unit_test(a_leaf_takes_memory_for_its_points_and_has_a_limit),
        cmocka_unit_test(any_order_of_tasks_does_the_same),
        cmocka_unit_test(tasks_that_are_left_out_run_on_the_calling_thread),
        cmocka_unit_test(tasks_that_are_repeated_or_out_of_range_do_no_harm),
        cmocka_unit_test(threads_of_another_floating_point_mode_change_no_answer),
        cmocka_unit_test(what_is_built_takes_the_same_memory_for_any_number_of_threads),
        cmocka_unit_test(tasks_survive_the_failure_of_each_allocation),
    };
    if (argc > 1)
        cmocka_set_test_filter(argv[1]);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
