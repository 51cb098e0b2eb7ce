/* SPDX-License-Identifier: MIT */
/* test_many_memory.c - memory of batches: a failure changes nothing, and the memory per point is bounded. */
#include "fixture.h"

#include <stdlib.h>

#include "brute.h"
#include "counting_allocator.h"
#include "octree/sample.h"

enum { million = 1000000, fifth = million / 5, rows = 400 };

static size_t memory_of(const octree *tree)
{
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    return stats.memory;
}

typedef enum change_kind { INSERT_MANY, REMOVE_MANY, MOVE_MANY, REPLACE_ALL, REWORLD } change_kind;

/* A tree to begin with, and a change to it. */
typedef struct attempt {
    const char *name;
    size_t capacity, depth;
    octree_full_leaf full_leaf;
    size_t stored; /* of the rows, inserted one by one before */
    change_kind kind;
    size_t from, count; /* the rows to insert, to remove or to move */
    bool own_statuses;  /* null is passed for the caller's */
} attempt;

static const attempt attempts[] = {
    {"bulk build", 4, 21, OCTREE_GROW, 0, INSERT_MANY, 0, rows, true},
    {"bulk build that refuses", 1, 6, OCTREE_REFUSE, 0, INSERT_MANY, 0, rows, false},
    {"bulk build of one leaf", 1000, 21, OCTREE_GROW, 0, INSERT_MANY, 0, rows, false},
    {"more points", 2, 21, OCTREE_GROW, 150, INSERT_MANY, 100, 300, false},
    {"more points that are refused", 2, 4, OCTREE_REFUSE, 150, INSERT_MANY, 100, 300, true},
    {"a few points", 8, 21, OCTREE_GROW, 380, INSERT_MANY, 370, 18, true},
    {"a few points into full leaves", 1, 21, OCTREE_GROW, 380, INSERT_MANY, 370, 18, false},
    {"a few points that are refused", 1, 3, OCTREE_REFUSE, 380, INSERT_MANY, 376, 8, true},
    {"all are there already", 2, 21, OCTREE_GROW, rows, INSERT_MANY, 0, rows, false},
    {"empty batch", 2, 21, OCTREE_GROW, 100, INSERT_MANY, 0, 0, true},
    {"remove half", 2, 21, OCTREE_GROW, 300, REMOVE_MANY, 150, 250, true},
    {"remove most, so that nodes merge", 8, 21, OCTREE_GROW, rows, REMOVE_MANY, 0, 390, false},
    {"remove all", 3, 21, OCTREE_GROW, rows, REMOVE_MANY, 0, rows, false},
    {"remove from one leaf", 1000, 21, OCTREE_GROW, rows, REMOVE_MANY, 100, 200, false},
    {"remove what is absent", 3, 21, OCTREE_REFUSE, 100, REMOVE_MANY, 200, 200, false},
    {"a few points one by one, of which one opens a block", 100, 21, OCTREE_GROW, 380, INSERT_MANY, 360, 40, true},
    {"a few into a large leaf", 1000, 21, OCTREE_GROW, 280, INSERT_MANY, 280, 30, true},
    {"move a few that are refused", 1, 3, OCTREE_REFUSE, 380, MOVE_MANY, 10, 9, true},
    {"move more that are refused", 1, 2, OCTREE_REFUSE, rows, MOVE_MANY, 0, 9, false},
    {"remove so that a large leaf is made", 100, 21, OCTREE_GROW, rows, REMOVE_MANY, 0, 310, true},
    {"move a few", 1, 21, OCTREE_GROW, 380, MOVE_MANY, 10, 9, false},
    {"move a few with repetitions", 4, 21, OCTREE_GROW, 380, MOVE_MANY, 10, 30, true},
    {"move within a large leaf", 1000, 21, OCTREE_GROW, 380, MOVE_MANY, 10, 9, true},
    {"move all", 2, 21, OCTREE_GROW, rows, MOVE_MANY, 0, rows, false},
    {"replace all", 2, 21, OCTREE_GROW, rows, REPLACE_ALL, 0, 390, false},
    {"replace all by few that are refused", 1, 3, OCTREE_REFUSE, rows, REPLACE_ALL, 0, 9, true},
    {"reworld", 2, 21, OCTREE_GROW, rows, REWORLD, 0, 0, false},
    {"reworld one leaf", 1000, 21, OCTREE_REFUSE, rows, REWORLD, 0, 0, false},
    {"reworld an empty tree", 2, 21, OCTREE_REFUSE, 0, REWORLD, 0, 0, false},
};

/* Every third at one of two positions, every tenth a repetition, the others spread. */
static void make_rows(octree_point points[rows])
{
    uint64_t random = 5;
    for (size_t i = 0; i < rows; i++) {
        points[i].id = i;
        for (int axis = 0; axis < 3; axis++)
            points[i].position[axis] =
                i % 3 == 0 ? 0.5 - (double)(i % 2) : (double)random_below(&random, 4097) / 2048 - 1;
        if (i % 10 == 9)
            points[i] = points[i - 5];
    }
}

static octree *begin(const attempt *a, counting_allocator *counts, const octree_point *points)
{
    octree *tree = make_counted_tree(counts, cube(-1, 1), a->capacity, a->depth, a->full_leaf);
    for (size_t i = 0; i < a->stored; i++) {
        const octree_status status = octree_insert(tree, points[i].position, points[i].id);
        assert_true(status == OCTREE_OK || status == OCTREE_DUPLICATE || status == OCTREE_FULL);
    }
    return tree;
}

static octree_status try(const attempt *a, octree *tree, const octree_point *points)
{
    static const octree_box larger = {{-3, -2, -1}, {1, 2, 5}};
    octree_status statuses[rows];
    size_t done;
    double to[rows][3];
    if (a->kind == REWORLD)
        return octree_reworld(tree, &larger);
    for (size_t i = 0; i < a->count; i++)
        for (int axis = 0; axis < 3; axis++)
            to[i][axis] = -points[a->from + i].position[axis];
    if (a->kind == MOVE_MANY)
        return octree_move_many(tree, points + a->from, (const double(*)[3])to, a->count,
                                a->own_statuses ? NULL : statuses, &done);
    if (a->kind == REPLACE_ALL)
        return octree_replace_all(tree, points + a->from, a->count, a->own_statuses ? NULL : statuses, &done);
    return (a->kind == INSERT_MANY ? octree_insert_many : octree_remove_many)(tree, points + a->from, a->count,
                                                                              a->own_statuses ? NULL : statuses, &done);
}

/* Do it with the n-th allocation failing, and where `all_after` is set those after it too. False when it needed fewer.
 */
static bool fails_without_a_trace(const attempt *a, const octree_point *points, size_t n, bool all_after,
                                  uint64_t expected)
{
    counting_allocator counts = {0};
    octree *tree = begin(a, &counts, points);
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    const size_t count = octree_count(tree);
    const octree_box world = octree_definition(tree).world;
    counting_allocator_fail_at(&counts, n);
    if (all_after)
        counts.fail_until = SIZE_MAX;
    const octree_status status = try(a, tree, points);
    const bool failed = counts.calls > counts.fail_from;
    counting_allocator_stop_failing(&counts);
    if (a->kind == MOVE_MANY) /* without memory to see whether a leaf overflows, it is moved one by one */
        assert_true(status == OCTREE_OK || (failed && status == OCTREE_NO_MEMORY));
    else
        assert_int_equal(status, failed ? OCTREE_NO_MEMORY : OCTREE_OK);
    assert_int_equal(memory_of(tree), counts.bytes);
    assert_valid(tree);
    if (status != OCTREE_OK) {
        assert_true(octree_digest(tree) == digest && octree_version(tree) == version);
        assert_int_equal(octree_count(tree), count);
        const octree_box after = octree_definition(tree).world;
        assert_memory_equal(&after, &world, sizeof world);
        assert_int_equal(try(a, tree, points), OCTREE_OK); /* with memory again it is as if nothing had been */
    }
    if (octree_digest(tree) != expected)
        fail_msg("%s: other contents after failure %d", a->name, (int)n);
    octree_destroy(tree);
    assert_all_returned(&counts);
    return failed;
}

static uint64_t digest_after(const attempt *a, const octree_point *points)
{
    counting_allocator counts = {0};
    octree *tree = begin(a, &counts, points);
    assert_int_equal(try(a, tree, points), OCTREE_OK);
    const uint64_t digest = octree_digest(tree);
    octree_destroy(tree);
    assert_all_returned(&counts);
    return digest;
}

static void changes_of_many_survive_the_failure_of_each_allocation(void **state)
{
    (void)state;
    octree_point points[rows];
    make_rows(points);
    for (size_t i = 0; i < sizeof attempts / sizeof attempts[0]; i++)
        for (int all_after = 0; all_after < 2; all_after++) {
            const uint64_t expected = digest_after(&attempts[i], points);
            size_t n = 0;
            while (fails_without_a_trace(&attempts[i], points, n, all_after, expected))
                n++;
            /* few moves need memory only for the leaves that they fill or split */
            if (n == 0 && attempts[i].count > 0 && attempts[i].kind != MOVE_MANY)
                fail_msg("%s took no memory", attempts[i].name);
        }
}

/* So many move that the tree is built anew; two points have one id, and one of them moves to where the other is. Ids
 * that lie close together have a bit each in a table, and others a place. */
static void build_anew_with_failures(uint64_t between_ids)
{
    enum { MOVED = 60 };
    octree_point points[100], from[MOVED];
    double to[MOVED][3];
    for (size_t i = 0; i < 100; i++)
        points[i] = (octree_point){{(double)i / 100, 0.5, -0.5}, i * between_ids};
    points[99].id = points[7].id;
    for (size_t i = 0; i < MOVED; i++) {
        from[i] = points[i];
        for (int axis = 0; axis < 3; axis++)
            to[i][axis] = i == 7 ? points[99].position[axis] : -points[i].position[axis];
    }
    octree_status status = OCTREE_NO_MEMORY;
    size_t failed = 0;
    for (; status == OCTREE_NO_MEMORY; failed++) {
        counting_allocator counts = {0};
        octree_status statuses[MOVED];
        size_t moved = 0;
        octree *tree = make_counted_tree(&counts, cube(-1, 1), 2, 21, OCTREE_GROW);
        assert_int_equal(octree_insert_many(tree, points, 100, NULL, NULL), OCTREE_OK);
        const uint64_t digest = octree_digest(tree);
        counting_allocator_fail_at(&counts, failed);
        status = octree_move_many(tree, from, (const double(*)[3])to, MOVED, statuses, &moved);
        counting_allocator_stop_failing(&counts);
        assert_valid(tree);
        assert_true(status == OCTREE_OK || octree_digest(tree) == digest);
        for (size_t i = 0; status == OCTREE_OK && i < MOVED; i++)
            assert_int_equal(statuses[i], i == 7 ? OCTREE_DUPLICATE : OCTREE_OK);
        assert_int_equal(moved, status == OCTREE_OK ? MOVED - 1 : 0);
        octree_destroy(tree);
        assert_all_returned(&counts);
    }
    assert_true(failed > 5);
}

static void a_move_that_builds_anew_leaves_no_trace_of_its_failure(void **state)
{
    (void)state;
    build_anew_with_failures(1);
    build_anew_with_failures(UINT64_C(1) << 40);
}

static void many_failures_on_one_tree_do_not_add_up(void **state)
{
    (void)state;
    octree_point points[rows];
    make_rows(points);
    const attempt a = {"", 2, 21, OCTREE_GROW, 150, INSERT_MANY, 0, rows, false};
    counting_allocator counts = {0};
    octree *tree = begin(&a, &counts, points);
    const uint64_t digest = octree_digest(tree);
    size_t limit = 0;
    for (size_t n = 0; n < 2000; n++) {
        counting_allocator_fail_at(&counts, n % 40);
        const octree_status status = try(&a, tree, points);
        counting_allocator_stop_failing(&counts);
        if (status == OCTREE_OK) {
            octree_destroy(tree);
            assert_all_returned(&counts);
            tree = begin(&a, &counts, points);
        }
        assert_true(octree_digest(tree) == digest);
        if (n == 200)
            limit = 2 * counts.peak;
        assert_true(limit == 0 || counts.peak <= limit);
    }
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static octree_point *make_points(size_t count)
{
    octree_point *points = malloc(count * sizeof *points);
    assert_non_null(points);
    uint64_t random = 8;
    for (size_t i = 0; i < count; i++) {
        points[i].id = i;
        for (int axis = 0; axis < 3; axis++)
            points[i].position[axis] = 2 * octree_random_unit(&random) - 1;
    }
    return points;
}

/* The number done. */
static size_t insert_many(octree *tree, const octree_point *points, size_t count)
{
    size_t inserted;
    assert_int_equal(octree_insert_many(tree, points, count, NULL, &inserted), OCTREE_OK);
    return inserted;
}

static void a_million_points_take_at_most_48_bytes_each(void **state)
{
    (void)state;
    octree_point *points = make_points(million);
    counting_allocator counts = {0}, counts_by_one = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 16, 21, OCTREE_REFUSE);
    octree *one_by_one = make_counted_tree(&counts_by_one, cube(-1, 1), 16, 21, OCTREE_REFUSE);
    assert_int_equal(insert_many(tree, points, million), million);
    assert_true(memory_of(tree) <= 48 * (size_t)million);
    assert_true(counts.peak <= 100 * (size_t)million);
    for (size_t i = 0; i < million; i++)
        assert_true(octree_insert(one_by_one, points[i].position, points[i].id) == OCTREE_OK);
    assert_true(memory_of(one_by_one) <= 48 * (size_t)million);
    assert_true(octree_digest(tree) == octree_digest(one_by_one));
    octree_destroy(one_by_one);
    size_t removed;
    assert_int_equal(octree_remove_many(tree, points, million, NULL, &removed), OCTREE_OK);
    assert_int_equal(removed, million);
    assert_true(counts.peak <= 100 * (size_t)million);
    assert_int_equal(memory_of(tree), counts.bytes);
    octree_destroy(tree);
    assert_all_returned(&counts);
    assert_all_returned(&counts_by_one);
    free(points);
}

static void batches_and_a_new_world_keep_memory_linear(void **state)
{
    (void)state;
    octree_point *points = make_points(fifth);
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 16, 21, OCTREE_REFUSE);
    for (size_t i = 0; i < 10; i++)
        assert_int_equal(insert_many(tree, points + i * (fifth / 10), fifth / 10), fifth / 10);
    assert_true(memory_of(tree) <= 100 * (size_t)fifth);
    for (size_t i = 0; i < 6; i++) { /* churn */
        const octree_point *tenth = points + i * (fifth / 10);
        assert_int_equal(octree_remove_many(tree, tenth, fifth / 10, NULL, NULL), OCTREE_OK);
        assert_int_equal(insert_many(tree, tenth, fifth / 10), fifth / 10);
        assert_true(memory_of(tree) <= 100 * (size_t)fifth);
    }
    const octree_box wider = cube(-2, 3);
    assert_int_equal(octree_reworld(tree, &wider), OCTREE_OK);
    assert_true(memory_of(tree) <= 48 * (size_t)fifth);
    assert_true(counts.peak <= 200 * (size_t)fifth);
    octree_destroy(tree);
    assert_all_returned(&counts);
    free(points);
}

/* The most bytes that a call takes beside the tree while all points move, whose ids begin with `first` and are so far
 * apart. */
static size_t peak_of_moves(uint64_t first, uint64_t step)
{
    enum { count = 10000 };
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 16, 21, OCTREE_GROW);
    octree_point *points = make_points(count);
    double(*to)[3] = malloc(count * sizeof *to);
    assert_non_null(to);
    for (size_t i = 0; i < count; i++) {
        points[i].id = first + i * step;
        for (int axis = 0; axis < 3; axis++)
            to[i][axis] = -points[i].position[axis];
    }
    assert_int_equal(insert_many(tree, points, count), count);
    const size_t before = counts.bytes;
    counts.peak = before;
    size_t moved = 0;
    assert_int_equal(octree_move_many(tree, points, (const double(*)[3])to, count, NULL, &moved), OCTREE_OK);
    assert_int_equal(moved, count);
    const size_t peak = counts.peak - before;
    assert_true(counts.peak <= 170 * (size_t)count); /* in the order given, with tables of pairs and leaves: 228 */
    octree_destroy(tree);
    assert_all_returned(&counts);
    free(to);
    free(points);
    return peak;
}

/* Ids side by side are looked up by themselves, wherever they begin. */
static void moves_take_as_much_memory_wherever_ids_begin(void **state)
{
    (void)state;
    for (uint64_t step = 1; step <= 3; step++) {
        const size_t peak = peak_of_moves(0, step);
        assert_int_equal(peak_of_moves(UINT64_C(1) << 40, step), peak);
        assert_int_equal(peak_of_moves(UINT64_MAX - 5000, step), peak);
    }
}

static void a_million_equal_points_are_one_leaf_or_refused(void **state)
{
    (void)state;
    octree_point *points = make_points(million);
    for (size_t i = 0; i < million; i++)
        points[i] = (octree_point){{0.3, 0.3, 0.3}, million - i};
    for (int grow = 0; grow < 2; grow++) {
        counting_allocator counts = {0};
        octree *tree = make_counted_tree(&counts, cube(-1, 1), 2, 21, grow ? OCTREE_GROW : OCTREE_REFUSE);
        assert_int_equal(insert_many(tree, points, million), grow ? million : 2);
        assert_int_equal(node_count(tree), grow ? OCTREE_MAX_DEPTH + 1 : 1);
        assert_true(octree_contains(tree, points[0].position, points[0].id));
        assert_true(memory_of(tree) <= (grow ? 48 * (size_t)million : 1 << 20));
        size_t removed;
        assert_int_equal(octree_remove_many(tree, points, million, NULL, &removed), OCTREE_OK);
        assert_int_equal(removed, grow ? million : 2);
        assert_true(memory_of(tree) <= 1 << 20);
        assert_true(counts.peak <= 100 * (size_t)million);
        octree_destroy(tree);
        assert_all_returned(&counts);
    }
    free(points);
}

static void a_million_times_the_same_pair_is_one_point(void **state)
{
    (void)state;
    octree_point *points = make_points(million);
    for (size_t i = 0; i < million; i++)
        points[i] = (octree_point){{0.3, 0.3, 0.3}, 7};
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 1, 21, OCTREE_GROW);
    assert_int_equal(insert_many(tree, points, million), 1);
    size_t removed;
    assert_int_equal(octree_remove_many(tree, points, million, NULL, &removed), OCTREE_OK);
    assert_int_equal(removed, 1);
    assert_true(counts.peak <= 100 * (size_t)million);
    assert_true(memory_of(tree) <= 1 << 20);
    octree_destroy(tree);
    assert_all_returned(&counts);
    free(points);
}

static void refused_points_take_no_memory(void **state)
{
    (void)state;
    /* The second half lies where the first does and is refused, each at the maximum depth, in one batch with the first
     * or after it: what was divided to find that out must not stay. */
    const size_t half = fifth / 2;
    octree_point *points = make_points(fifth);
    for (size_t i = half; i < fifth; i++) {
        points[i] = points[i - half];
        points[i].id = i;
    }
    for (size_t first = half; first <= fifth; first += half) {
        counting_allocator counts = {0};
        octree *tree = make_counted_tree(&counts, cube(-1, 1), 1, 21, OCTREE_REFUSE);
        assert_int_equal(insert_many(tree, points, first), half);
        assert_int_equal(insert_many(tree, points + half, half), 0);
        /* One by one it is 61; a batch makes leaves anew beside the old ones, which doubles that at most. */
        assert_true(memory_of(tree) <= 125 * half);
        assert_true(counts.peak <= 150 * (size_t)fifth);
        octree_destroy(tree);
        assert_all_returned(&counts);
    }
    free(points);
}

static void a_small_batch_into_a_hashed_leaf_takes_memory_for_that_leaf_alone(void **state)
{
    (void)state;
    octree_point *points = make_points(fifth);
    for (size_t i = 0; i < fifth; i++)
        points[i] = (octree_point){{0.3, 0.3, 0.3}, i};
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 2, 21, OCTREE_GROW);
    const size_t most = fifth - 10;
    assert_int_equal(insert_many(tree, points, most), most);
    for (int i = 0; i < 3; i++) {
        counts.peak = counts.bytes;
        assert_int_equal(insert_many(tree, points + most, 10), 10);
        assert_int_equal(octree_remove_many(tree, points + most, 10, NULL, NULL), OCTREE_OK);
        assert_int_equal(octree_count(tree), most);
        assert_true(counts.peak - counts.bytes <= 100 * most);
        assert_true(counts.bytes <= 48 * most);
    }
    assert_valid(tree);
    octree_destroy(tree);
    assert_all_returned(&counts);
    free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changes_of_many_survive_the_failure_of_each_allocation),
        cmocka_unit_test(a_move_that_builds_anew_leaves_no_trace_of_its_failure),
        cmocka_unit_test(many_failures_on_one_tree_do_not_add_up),
        cmocka_unit_test(a_million_points_take_at_most_48_bytes_each),
        cmocka_unit_test(batches_and_a_new_world_keep_memory_linear),
        cmocka_unit_test(moves_take_as_much_memory_wherever_ids_begin),
        cmocka_unit_test(a_million_equal_points_are_one_leaf_or_refused),
        cmocka_unit_test(a_million_times_the_same_pair_is_one_point),
        cmocka_unit_test(refused_points_take_no_memory),
        cmocka_unit_test(a_small_batch_into_a_hashed_leaf_takes_memory_for_that_leaf_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
