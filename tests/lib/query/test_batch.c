/* SPDX-License-Identifier: MIT */
/* test_batch.c - octree_nearest_batch() equals single searches, in any order of targets. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "brute.h"
#include "counting_allocator.h"

enum { TARGETS = 200 };

/* What a batch fills in, with room for TARGETS. */
typedef struct answers {
    octree_neighbor neighbors[TARGETS];
    bool found[TARGETS];
    octree_cost cost;
} answers;

/* A pattern that no search would write. */
static void clear_answers(answers *all)
{
    memset(all->neighbors, 0x5a, sizeof all->neighbors);
    memset(all->found, 1, sizeof all->found);
    all->cost = (octree_cost){1000, 2000, 3000, 4000, 5000};
}

/* Bit for bit, -0.0 and distances included. An octree_neighbor has no padding. */
static bool same_answers(const answers *a, const answers *b)
{
    _Static_assert(sizeof(octree_neighbor) == 5 * sizeof(double), "compared as bytes");
    return memcmp(a->neighbors, b->neighbors, sizeof a->neighbors) == 0 &&
           memcmp(a->found, b->found, sizeof a->found) == 0 && a->cost.nodes == b->cost.nodes &&
           a->cost.leaves == b->cost.leaves && a->cost.points == b->cost.points && a->cost.pruned == b->cost.pruned &&
           a->cost.taken == b->cost.taken;
}

static void ask_one_by_one(const octree *tree, const double (*targets)[3], octree_search how, answers *all)
{
    how.cost = &all->cost;
    for (size_t i = 0; i < TARGETS; i++) {
        size_t count;
        octree_neighbor nearest;
        assert_int_equal(octree_nearest_k(tree, targets[i], 1, &how, &nearest, &count), OCTREE_OK);
        all->found[i] = count == 1;
        if (count == 1)
            all->neighbors[i] = nearest;
    }
}

static octree_status ask_at_once(const octree *tree, const double (*targets)[3], octree_search how, answers *all)
{
    how.cost = &all->cost;
    return octree_nearest_batch(tree, targets, TARGETS, &how, all->neighbors, all->found);
}

static void assert_same_as_one_by_one(const octree *tree, const double (*targets)[3], octree_search how)
{
    answers expected, given;
    clear_answers(&expected);
    clear_answers(&given);
    ask_one_by_one(tree, targets, how, &expected);
    assert_int_equal(ask_at_once(tree, targets, how, &given), OCTREE_OK);
    assert_true(same_answers(&expected, &given));
}

/* Targets in no order, within the world and far outside of it, upon points, and every fifth a repetition. */
static void make_targets(const brute *all, uint64_t *random, double targets[TARGETS][3])
{
    static const double reaches[] = {9, 12, 1e6, 1e200, DBL_MAX};
    for (size_t i = 0; i < TARGETS; i++) {
        const double reach = reaches[random_below(random, 5)];
        for (int axis = 0; axis < 3; axis++)
            targets[i][axis] = random_between(random, -reach, reach);
        if (i % 5 == 1)
            memcpy(targets[i], all->points[random_below(random, all->count)].position, sizeof targets[i]);
        if (i % 5 == 4)
            memcpy(targets[i], targets[random_below(random, i)], sizeof targets[i]);
    }
}

static octree *make_points(brute *all, uint64_t *random, size_t count)
{
    brute_scatter(all, random, count, 9, 40);
    for (size_t i = 0; i < all->count; i += 7)
        if (all->points[i].position[0] == 0)
            all->points[i].position[0] = -0.0;
    return brute_tree(all, cube(-10, 10), 2, 12);
}

static void a_batch_equals_single_searches_under_every_option(void **state)
{
    (void)state;
    static const octree_skip skips[] = {OCTREE_SKIP_NONE, OCTREE_SKIP_ID, OCTREE_SKIP_COINCIDENT};
    static const octree_mode modes[] = {OCTREE_EXACT, OCTREE_FAST};
    static const double epsilons[] = {0, 5e-324, 0.1, 3, DBL_MAX};
    uint64_t random = 1;
    for (size_t i = 0; i < 30; i++) {
        brute all = {0};
        double targets[TARGETS][3];
        octree *tree = make_points(&all, &random, i % 2 == 0 ? 900 : 20);
        make_targets(&all, &random, targets);
        const octree_search how = {.skip = skips[i % 3],
                                   .skip_id = all.points[random_below(&random, all.count)].id,
                                   .mode = modes[i / 3 % 2],
                                   .epsilon = epsilons[i / 6 % 5]};
        assert_same_as_one_by_one(tree, (const double(*)[3])targets, how);
        octree_destroy(tree);
        brute_free(&all);
    }
}

static void a_batch_is_the_truth_for_whole_numbers(void **state)
{
    (void)state;
    uint64_t random = 2;
    brute all = {0};
    octree *tree = make_points(&all, &random, 500);
    double targets[TARGETS][3];
    for (size_t i = 0; i < TARGETS; i++)
        for (int axis = 0; axis < 3; axis++)
            targets[i][axis] = (double)random_below(&random, 61) - 30;
    answers given;
    clear_answers(&given);
    assert_int_equal(
        octree_nearest_batch(tree, (const double(*)[3])targets, TARGETS, NULL, given.neighbors, given.found),
        OCTREE_OK);
    for (size_t i = 0; i < TARGETS; i++) {
        octree_neighbor nearest;
        assert_true(brute_nearest(&all, targets[i], OCTREE_SKIP_NONE, 0, &nearest));
        assert_true(given.found[i] && given.neighbors[i].point.id == nearest.point.id);
        assert_true(given.neighbors[i].distance == nearest.distance);
    }
    octree_destroy(tree);
    brute_free(&all);
}

static void the_order_of_the_targets_changes_nothing(void **state)
{
    (void)state;
    uint64_t random = 3;
    brute all = {0};
    octree *tree = make_points(&all, &random, 500);
    double targets[TARGETS][3], backwards[TARGETS][3];
    make_targets(&all, &random, targets);
    for (size_t i = 0; i < TARGETS; i++)
        memcpy(backwards[i], targets[TARGETS - 1 - i], sizeof backwards[i]);
    answers there, back;
    clear_answers(&there);
    clear_answers(&back);
    const octree_search how = {.skip = OCTREE_SKIP_COINCIDENT};
    assert_int_equal(ask_at_once(tree, (const double(*)[3])targets, how, &there), OCTREE_OK);
    assert_int_equal(ask_at_once(tree, (const double(*)[3])backwards, how, &back), OCTREE_OK);
    for (size_t i = 0; i < TARGETS; i++)
        assert_memory_equal(&there.neighbors[i], &back.neighbors[TARGETS - 1 - i], sizeof(octree_neighbor));
    assert_true(there.cost.nodes == back.cost.nodes && there.cost.points == back.cost.points);
    octree_destroy(tree);
    brute_free(&all);
}

static void worlds_of_every_scale_take_targets_of_every_scale(void **state)
{
    (void)state;
    const octree_box worlds[] = {cube(-DBL_MAX, DBL_MAX), cube(5e-324, 1e-310), cube(1e15, 1e15 + 1), cube(-1, 1)};
    static const double values[] = {0, -0.0, 5e-324, 1e-311, -1e-311, 1, -1, 1e15, 1e200, -1e200, DBL_MAX, -DBL_MAX};
    uint64_t random = 4;
    for (size_t w = 0; w < sizeof worlds / sizeof worlds[0]; w++) {
        brute all = {0};
        brute_sample(&all, OCTREE_SAMPLE_UNIFORM, w, &worlds[w], 100);
        octree *tree = brute_tree(&all, worlds[w], 2, 21);
        double targets[TARGETS][3];
        for (size_t i = 0; i < TARGETS; i++)
            for (int axis = 0; axis < 3; axis++)
                targets[i][axis] = values[random_below(&random, 12)];
        assert_same_as_one_by_one(tree, (const double(*)[3])targets, (octree_search){0});
        octree_destroy(tree);
        brute_free(&all);
    }
}

static void an_empty_tree_finds_none_and_writes_no_neighbors(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    const double targets[TARGETS][3] = {{0.5, 0, 0}, {9, 9, 9}, {-DBL_MAX, 0, 0}};
    answers untouched, given;
    clear_answers(&untouched);
    clear_answers(&given);
    assert_int_equal(octree_nearest_batch(tree, targets, TARGETS, NULL, given.neighbors, given.found), OCTREE_OK);
    for (size_t i = 0; i < TARGETS; i++)
        assert_false(given.found[i]);
    assert_memory_equal(given.neighbors, untouched.neighbors, sizeof given.neighbors);
    assert_int_equal(octree_nearest_batch(tree, targets, TARGETS, NULL, given.neighbors, NULL), OCTREE_OK);
    assert_memory_equal(given.neighbors, untouched.neighbors, sizeof given.neighbors);
    octree_destroy(tree);
}

static void only_results_of_targets_without_a_neighbor_are_not_written(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){0.5, 0, -0.0}, 7), OCTREE_OK);
    const double targets[3][3] = {{0.5, -0.0, 0}, {0, 0, 0}, {0.5, 0, 0}};
    answers given, untouched;
    clear_answers(&given);
    clear_answers(&untouched);
    const octree_search how = {.skip = OCTREE_SKIP_COINCIDENT};
    assert_int_equal(octree_nearest_batch(tree, targets, 3, &how, given.neighbors, given.found), OCTREE_OK);
    assert_true(!given.found[0] && given.found[1] && !given.found[2]);
    assert_int_equal(given.neighbors[1].point.id, 7);
    assert_true(given.neighbors[1].distance == 0.5);
    given.neighbors[1] = untouched.neighbors[1];
    assert_memory_equal(given.neighbors, untouched.neighbors, sizeof given.neighbors);
    octree_destroy(tree);
}

static void nothing_is_written_past_the_last_target(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){0.5, 0, 0}, 7), OCTREE_OK);
    const double targets[2][3] = {{0, 0, 0}, {1, 1, 1}};
    for (size_t count = 0; count <= 2; count++) {
        answers given, untouched;
        clear_answers(&given);
        clear_answers(&untouched);
        assert_int_equal(octree_nearest_batch(tree, targets, count, NULL, given.neighbors, given.found), OCTREE_OK);
        const size_t rest = TARGETS - count;
        assert_memory_equal(given.neighbors + count, untouched.neighbors + count, rest * sizeof(octree_neighbor));
        assert_memory_equal(given.found + count, untouched.found + count, rest * sizeof(bool));
    }
    octree_destroy(tree);
}

static void a_target_that_is_not_finite_leaves_everything_untouched(void **state)
{
    (void)state;
    static const double values[] = {NAN, INFINITY, -INFINITY};
    static const size_t places[] = {0, 1, TARGETS / 2, TARGETS - 1};
    uint64_t random = 5;
    brute all = {0};
    octree *tree = make_points(&all, &random, 100);
    double targets[TARGETS][3];
    make_targets(&all, &random, targets);
    answers untouched;
    clear_answers(&untouched);
    for (size_t i = 0; i < 36; i++) {
        double *bad = &targets[places[i / 9]][i / 3 % 3];
        const double good = *bad;
        answers given;
        clear_answers(&given);
        *bad = values[i % 3];
        assert_int_equal(ask_at_once(tree, (const double(*)[3])targets, (octree_search){0}, &given), OCTREE_NOT_FINITE);
        assert_true(same_answers(&given, &untouched));
        *bad = good;
    }
    octree_destroy(tree);
    brute_free(&all);
}

static void bad_options_are_refused_as_by_a_single_search(void **state)
{
    (void)state;
    static const struct {
        octree_search how;
        octree_status status;
    } cases[] = {
        {{.skip = (octree_skip)3}, OCTREE_BAD_OPTION}, {{.mode = (octree_mode)2}, OCTREE_BAD_OPTION},
        {{.epsilon = -0.5}, OCTREE_BAD_SIZE},          {{.epsilon = -5e-324}, OCTREE_BAD_SIZE},
        {{.epsilon = NAN}, OCTREE_NOT_FINITE},         {{.epsilon = INFINITY}, OCTREE_NOT_FINITE},
    };
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){0.5, 0, 0}, 7), OCTREE_OK);
    static const double targets[TARGETS][3];
    answers given, untouched;
    clear_answers(&given);
    clear_answers(&untouched);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(ask_at_once(tree, targets, cases[i].how, &given), cases[i].status);
        assert_true(same_answers(&given, &untouched));
    }
    octree_destroy(tree);
}

static void null_is_refused_except_for_how_and_found(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){0.5, 0, 0}, 7), OCTREE_OK);
    const double targets[1][3] = {{0, 0, 0}};
    octree_neighbor nearest;
    bool found = false;
    assert_int_equal(octree_nearest_batch(NULL, targets, 1, NULL, &nearest, &found), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest_batch(tree, NULL, 1, NULL, &nearest, &found), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest_batch(tree, targets, 1, NULL, NULL, &found), OCTREE_NULL_ARGUMENT);
    assert_false(found);
    assert_int_equal(octree_nearest_batch(tree, targets, 1, NULL, &nearest, NULL), OCTREE_OK);
    assert_int_equal(nearest.point.id, 7);
    assert_int_equal(octree_nearest_batch(tree, NULL, 0, NULL, NULL, NULL), OCTREE_OK);
#if SIZE_MAX > UINT32_MAX
    assert_int_equal(octree_nearest_batch(tree, targets, (size_t)UINT32_MAX + 1, NULL, &nearest, NULL),
                     OCTREE_TOO_MANY);
#endif
    octree_destroy(tree);
}

static void count_trace(octree_address node, octree_trace_kind touch, void *context)
{
    (void)node;
    ((size_t *)context)[touch]++;
}

/* The tracer is called by one thread, in the order of the tree. */
static void a_batch_is_traced_as_its_searches_are(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_GROW);
    double targets[20][3];
    size_t singly[8] = {0}, together[8] = {0};
    uint64_t random = 3;
    for (uint64_t id = 0; id < 20; id++) {
        for (int axis = 0; axis < 3; axis++)
            targets[id][axis] = random_between(&random, -1, 1);
        assert_int_equal(octree_insert(tree, targets[id], id), OCTREE_OK);
    }
    octree_search how = {.skip = OCTREE_SKIP_COINCIDENT, .trace = count_trace, .trace_context = together};
    octree_neighbor neighbors[20];
    size_t found;
    assert_int_equal(octree_nearest_batch(tree, (const double(*)[3])targets, 20, &how, neighbors, NULL), OCTREE_OK);
    how.trace_context = singly;
    for (size_t i = 0; i < 20; i++) {
        octree_neighbor one;
        assert_int_equal(octree_nearest_k(tree, targets[i], 1, &how, &one, &found), OCTREE_OK);
        assert_int_equal(one.point.id, neighbors[i].point.id);
    }
    assert_true(singly[OCTREE_TRACE_VISITED] > 0);
    assert_memory_equal(singly, together, sizeof singly);
    octree_destroy(tree);
}

static void a_failed_allocation_leaves_everything_untouched(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){0.5, 0, 0}, 7), OCTREE_OK);
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    static const double targets[TARGETS][3];
    answers given, untouched;
    clear_answers(&given);
    clear_answers(&untouched);
    size_t failures = 0;
    octree_status status;
    for (;; failures++) {
        counting_allocator_fail_at(&counts, failures);
        status = ask_at_once(tree, targets, (octree_search){0}, &given);
        counting_allocator_stop_failing(&counts);
        if (status != OCTREE_NO_MEMORY)
            break;
        assert_true(same_answers(&given, &untouched));
        assert_true(octree_digest(tree) == digest && octree_version(tree) == version);
    }
    assert_int_equal(status, OCTREE_OK);
    assert_true(failures > 0);
    assert_true(given.found[TARGETS - 1] && given.neighbors[TARGETS - 1].point.id == 7);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static void a_batch_takes_32_bytes_a_target_and_gives_them_back(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){0.5, 0, 0}, 7), OCTREE_OK);
    const size_t before = counts.bytes;
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    octree_stats stats, after;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    static const double targets[TARGETS][3];
    answers given;
    counts.peak = before;
    assert_int_equal(ask_at_once(tree, targets, (octree_search){.cost = NULL}, &given), OCTREE_OK);
    assert_true(counts.peak - before <= 32 * TARGETS);
    assert_int_equal(counts.bytes, before);
    assert_int_equal(octree_statistics(tree, &after), OCTREE_OK);
    assert_int_equal(after.memory, stats.memory);
    assert_true(octree_digest(tree) == digest && octree_version(tree) == version);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_batch_equals_single_searches_under_every_option),
        cmocka_unit_test(a_batch_is_the_truth_for_whole_numbers),
        cmocka_unit_test(the_order_of_the_targets_changes_nothing),
        cmocka_unit_test(worlds_of_every_scale_take_targets_of_every_scale),
        cmocka_unit_test(an_empty_tree_finds_none_and_writes_no_neighbors),
        cmocka_unit_test(only_results_of_targets_without_a_neighbor_are_not_written),
        cmocka_unit_test(nothing_is_written_past_the_last_target),
        cmocka_unit_test(a_target_that_is_not_finite_leaves_everything_untouched),
        cmocka_unit_test(bad_options_are_refused_as_by_a_single_search),
        cmocka_unit_test(null_is_refused_except_for_how_and_found),
        cmocka_unit_test(a_batch_is_traced_as_its_searches_are),
        cmocka_unit_test(a_failed_allocation_leaves_everything_untouched),
        cmocka_unit_test(a_batch_takes_32_bytes_a_target_and_gives_them_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
