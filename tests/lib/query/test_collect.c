/* SPDX-License-Identifier: MIT */
/* test_collect.c - range results in an array: those that fit are stored, all are counted, sorted if requested. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "brute.h"
#include "counting_allocator.h"

typedef octree_status collector(const octree *tree, const octree_box *box, const octree_search *how,
                                octree_point *points, size_t room, size_t *count);

static collector *const collectors[] = {octree_range_collect, octree_range_collect_sorted};

/* An array that no query has written to, with `spare` points more than asked for. */
static octree_point *blank_points(size_t room, size_t spare)
{
    octree_point *points = malloc((room + spare + 1) * sizeof *points);
    assert_non_null(points);
    memset(points, 0x5a, (room + spare + 1) * sizeof *points);
    return points;
}

static void assert_blank(const octree_point *points, size_t count)
{
    const unsigned char *bytes = (const unsigned char *)points;
    for (size_t i = 0; i < count * sizeof *points; i++)
        assert_int_equal(bytes[i], 0x5a);
}

/* The test fails unless the points are pairs of `expected`, each at most once. */
static void assert_among(const octree_point *points, size_t count, const brute *expected)
{
    brute seen = {0};
    for (size_t i = 0; i < count; i++) {
        assert_true(brute_contains(expected, points[i].position, points[i].id));
        assert_false(brute_contains(&seen, points[i].position, points[i].id));
        brute_collect(&points[i], &seen);
    }
    brute_free(&seen);
}

/* As assert_among, and they must be the first of `expected` in its order. */
static void assert_first_of(const octree_point *points, size_t count, const brute *expected)
{
    for (size_t i = 0; i < count; i++)
        assert_true(points[i].id == expected->points[i].id &&
                    same_position(points[i].position, expected->points[i].position));
}

/* Both collectors with this room; `expected` is in order. Three points more are there, and must stay as they are. */
static void assert_collected(const octree *tree, const octree_box *box, const octree_search *how, const brute *expected,
                             size_t room)
{
    const size_t stored = expected->count < room ? expected->count : room;
    for (size_t sorted = 0; sorted < 2; sorted++) {
        octree_point *points = blank_points(room, 3);
        size_t count = SIZE_MAX;
        assert_int_equal(collectors[sorted](tree, box, how, points, room, &count), OCTREE_OK);
        assert_int_equal(count, expected->count);
        assert_among(points, stored, expected);
        if (sorted)
            assert_first_of(points, stored, expected);
        assert_blank(points + stored, room + 3 - stored);
        free(points);
    }
}

static void assert_collected_with_every_room(const octree *tree, const octree_box *box, const octree_search *how,
                                             brute *expected)
{
    assert_true(brute_equal(expected, expected)); /* which sorts */
    const size_t n = expected->count, rooms[] = {0, 1, 2, 3, n / 2, n - (n > 0), n, n + 1, n + 100};
    for (size_t i = 0; i < sizeof rooms / sizeof rooms[0]; i++)
        assert_collected(tree, box, how, expected, rooms[i]);
}

/* A closed box with whole corners, or halves, that may be of no size or beyond the world. */
static octree_box random_box(uint64_t *random)
{
    octree_box box;
    for (int axis = 0; axis < 3; axis++) {
        box.min[axis] = (double)random_below(random, 60) / 2 - 15;
        box.max[axis] = box.min[axis] + (double)random_below(random, 40) / 2;
    }
    return box;
}

static void an_array_of_any_size_takes_what_fits_and_all_are_counted(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < 60; i++) {
        brute all = {0}, expected = {0};
        brute_scatter(&all, &random, 300, 10, 1 + random_below(&random, 300)); /* from one id for all to many */
        octree *tree = brute_tree(&all, cube(-10, 10), 1 + random_below(&random, 8), random_below(&random, 8));
        const octree_box box = i % 10 == 0 ? cube(-10, 10) : random_box(&random);
        brute_range(&all, &box, &expected);
        assert_collected_with_every_room(tree, &box, NULL, &expected);
        brute_free(&all);
        brute_free(&expected);
        octree_destroy(tree);
    }
}

static void equal_ids_are_ordered_by_position(void **state)
{
    (void)state;
    static const octree_point sorted[] = {
        {{5, 5, 5}, 0},         {{-1, 9, 9}, 3},         {{0, -2, 9}, 3},         {{-0.0, 0, -9}, 3},
        {{0, 0, 1}, 3},         {{-0.0, 0, 2}, 3},       {{0, 1, -9}, 3},         {{1, -9, 0}, 3},
        {{-9, -9, -9}, 4},      {{0, 0, 0}, 255},        {{0, 0, 0}, 65536},      {{0, 0, 0}, 1ull << 40},
        {{0, 0, 0}, INT64_MAX}, {{0, 0, 0}, 1ull << 63}, {{0, 0, 0}, UINT64_MAX},
    };
    const size_t n = sizeof sorted / sizeof sorted[0];
    octree *tree = make_tree(cube(-10, 10), 2, 6, OCTREE_GROW);
    for (size_t i = 0; i < n; i++) { /* 7 and 15 have no common divisor: each once, in another order */
        const octree_point *p = &sorted[i * 7 % n];
        assert_int_equal(octree_insert(tree, p->position, p->id), OCTREE_OK);
    }
    const octree_box box = cube(-10, 10);
    for (size_t room = 0; room <= n; room++) {
        octree_point points[15];
        size_t count = 0;
        assert_int_equal(octree_range_collect_sorted(tree, &box, NULL, points, room, &count), OCTREE_OK);
        assert_int_equal(count, n);
        assert_memory_equal(points, sorted, room * sizeof *points); /* the bits that were stored, -0.0 included */
    }
    octree_destroy(tree);
}

static void many_points_at_one_place_come_by_id(void **state)
{
    (void)state;
    brute all = {0};
    for (uint64_t id = 0; id < 1000; id++)
        brute_insert(&all, (double[3]){0.25, 0.25, 0.25}, id * 617 % 1009);
    octree *tree = brute_tree(&all, cube(0, 1), 2, 21);
    const octree_box box = {{0.25, 0.25, 0.25}, {0.25, 0.25, 0.25}};
    assert_true(brute_equal(&all, &all));
    for (size_t room = 0; room <= 1001; room += 143)
        assert_collected(tree, &box, NULL, &all, room);
    octree_destroy(tree);
    brute_free(&all);
}

static void no_points_are_needed_to_count(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){0.5, 0, 0}, 7), OCTREE_OK);
    const octree_box box = cube(-1, 1), beside = cube(2, 3);
    for (size_t sorted = 0; sorted < 2; sorted++) {
        size_t count = 99;
        assert_int_equal(collectors[sorted](tree, &box, NULL, NULL, 0, &count), OCTREE_OK);
        assert_int_equal(count, 1);
        assert_int_equal(collectors[sorted](tree, &beside, NULL, NULL, 0, &count), OCTREE_OK);
        assert_int_equal(count, 0);
    }
    octree_destroy(tree);
}

static void a_room_without_end_is_not_counted_through(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){0.5, 0, 0}, 7), OCTREE_OK);
    const octree_box box = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    for (size_t sorted = 0; sorted < 2; sorted++) {
        octree_point *points = blank_points(1, 1);
        size_t count = 99;
        assert_int_equal(collectors[sorted](tree, &box, NULL, points, SIZE_MAX, &count), OCTREE_OK);
        assert_int_equal(count, 1);
        assert_int_equal(points[0].id, 7);
        assert_blank(points + 1, 1);
        free(points);
    }
    octree_destroy(tree);
}

/* The set that octree_range_search visits, which must hold the box and nothing farther than epsilon outside it. */
static void expect_within_epsilon(const octree *tree, const brute *all, const octree_box *box, const octree_search *how,
                                  brute *expected)
{
    octree_box wide = *box;
    for (int axis = 0; axis < 3; axis++) { /* exact: halves, and eighths */
        wide.min[axis] -= how->epsilon;
        wide.max[axis] += how->epsilon;
    }
    octree_search uncounted = *how;
    uncounted.cost = NULL;
    assert_int_equal(octree_range_search(tree, box, &uncounted, brute_collect, expected), OCTREE_OK);
    for (size_t i = 0; i < all->count; i++) {
        const octree_point *p = &all->points[i];
        const bool visited = brute_contains(expected, p->position, p->id);
        assert_true(visited || !box_holds(box, p->position));
        assert_true(!visited || box_holds(&wide, p->position));
    }
}

static void epsilon_is_respected_with_every_room(void **state)
{
    (void)state;
    static const double epsilons[] = {0, 0.125, 1, 2.5, 64};
    uint64_t random = 2;
    size_t more = 0;
    for (size_t i = 0; i < 60; i++) {
        brute all = {0}, expected = {0}, inside = {0};
        brute_scatter(&all, &random, 300, 10, 20);
        octree *tree = brute_tree(&all, cube(-16, 16), 2, 8);
        const octree_box box = random_box(&random);
        const octree_search how = {.epsilon = epsilons[i % 5], .mode = i % 2 == 0 ? OCTREE_EXACT : OCTREE_FAST};
        expect_within_epsilon(tree, &all, &box, &how, &expected);
        assert_collected_with_every_room(tree, &box, &how, &expected);
        brute_range(&all, &box, &inside);
        more += expected.count > inside.count;
        brute_free(&all);
        brute_free(&expected);
        brute_free(&inside);
        octree_destroy(tree);
    }
    assert_true(more > 0); /* else this told nothing about epsilon */
}

static void the_cost_is_that_of_the_search_and_is_added_to(void **state)
{
    (void)state;
    uint64_t random = 3;
    brute all = {0};
    brute_scatter(&all, &random, 500, 10, 500);
    octree *tree = brute_tree(&all, cube(-10, 10), 2, 8);
    for (size_t i = 0; i < 100; i++) {
        const octree_box box = random_box(&random);
        octree_cost searched = {1, 2, 3, 4, 5}, collected = {1, 2, 3, 4, 5};
        brute found = {0};
        octree_search how = {.epsilon = i % 3 == 0 ? 1 : 0, .cost = &searched};
        assert_int_equal(octree_range_search(tree, &box, &how, brute_collect, &found), OCTREE_OK);
        brute_free(&found);
        how.cost = &collected;
        octree_point points[5];
        size_t count;
        assert_int_equal(collectors[i % 2](tree, &box, &how, points, i % 6, &count), OCTREE_OK);
        assert_memory_equal(&searched, &collected, sizeof searched);
    }
    octree_destroy(tree);
    brute_free(&all);
}

static void invalid_queries_are_refused_and_write_nothing(void **state)
{
    (void)state;
    static const struct {
        double low, high;
        octree_search how;
        octree_status status;
    } cases[] = {
        {NAN, 1, {0}, OCTREE_NOT_FINITE},
        {-1, NAN, {0}, OCTREE_NOT_FINITE},
        {1, -1, {0}, OCTREE_BAD_RANGE},
        {INFINITY, -INFINITY, {0}, OCTREE_BAD_RANGE},
        {-1, 1, {.epsilon = -1}, OCTREE_BAD_SIZE},
        {-1, 1, {.epsilon = NAN}, OCTREE_NOT_FINITE},
        {-1, 1, {.epsilon = INFINITY}, OCTREE_NOT_FINITE},
        {-1, 1, {.mode = (octree_mode)2}, OCTREE_BAD_OPTION},
    };
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){0.5, 0, 0}, 7), OCTREE_OK);
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        const octree_box box = {{-1, cases[i / 2].low, -1}, {1, cases[i / 2].high, 1}};
        octree_point *points = blank_points(4, 0);
        size_t count;
        assert_int_equal(collectors[i % 2](tree, &box, &cases[i / 2].how, points, 4, &count), cases[i / 2].status);
        assert_blank(points, 4);
        free(points);
    }
    octree_destroy(tree);
}

static void assert_null_argument(size_t sorted, const octree *tree, const octree_box *box, octree_point *points)
{
    size_t count = 777;
    assert_int_equal(collectors[sorted](tree, box, NULL, points, 2, &count), OCTREE_NULL_ARGUMENT);
    assert_int_equal(count, 0);
}

static void null_is_refused_except_for_how(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    const octree_box box = cube(-1, 1);
    octree_point points[2];
    for (size_t sorted = 0; sorted < 2; sorted++) {
        assert_null_argument(sorted, NULL, &box, points);
        assert_null_argument(sorted, tree, NULL, points);
        assert_null_argument(sorted, tree, &box, NULL);
        assert_int_equal(collectors[sorted](tree, &box, NULL, points, 2, NULL), OCTREE_NULL_ARGUMENT);
    }
    octree_destroy(tree);
}

static void collecting_needs_no_memory_and_changes_nothing(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-10, 10), 1, 5, OCTREE_GROW);
    for (uint64_t id = 0; id < 50; id++)
        assert_int_equal(octree_insert(tree, (double[3]){0, (double)id / 5, 0}, id * 37 % 50), OCTREE_OK);
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    const octree_box box = cube(-10, 10);
    const size_t calls = counts.calls;
    counting_allocator_fail_at(&counts, 0);
    for (size_t sorted = 0; sorted < 2; sorted++) {
        octree_point points[50];
        size_t count;
        assert_int_equal(collectors[sorted](tree, &box, NULL, points, sorted == 0 ? 50 : 20, &count), OCTREE_OK);
        assert_int_equal(count, 50);
    }
    assert_int_equal(counts.calls, calls);
    assert_true(octree_digest(tree) == digest && octree_version(tree) == version);
    counting_allocator_stop_failing(&counts);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_array_of_any_size_takes_what_fits_and_all_are_counted),
        cmocka_unit_test(equal_ids_are_ordered_by_position),
        cmocka_unit_test(many_points_at_one_place_come_by_id),
        cmocka_unit_test(no_points_are_needed_to_count),
        cmocka_unit_test(a_room_without_end_is_not_counted_through),
        cmocka_unit_test(epsilon_is_respected_with_every_room),
        cmocka_unit_test(the_cost_is_that_of_the_search_and_is_added_to),
        cmocka_unit_test(invalid_queries_are_refused_and_write_nothing),
        cmocka_unit_test(null_is_refused_except_for_how),
        cmocka_unit_test(collecting_needs_no_memory_and_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
