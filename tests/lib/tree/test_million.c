/* SPDX-License-Identifier: MIT */
/* test_million.c - a million points, equal or not: linear memory, constant time a point, and 64 KiB of stack for all of
 * it, the tests themselves included.
 */
#include "fixture.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "counting_allocator.h"
#include "octree/sample.h"

enum { million = 1000000 };

static void a_million_equal_points_are_refused_without_taking_memory(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 2, 21, OCTREE_REFUSE);
    const double at[3] = {0.3, 0.3, 0.3};
    for (uint64_t id = 0; id < million; id++)
        assert_int_equal(octree_insert(tree, at, id), id < 2 ? OCTREE_OK : OCTREE_FULL);
    assert_true(counts.peak < 1 << 20);
    assert_valid(tree);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

/* Of leaves with one point each no grid is fine enough. */
static void more_points_than_the_finest_grid_has_cells_for_are_sorted(void **state)
{
    (void)state;
    enum { SIDE = 114, COUNT = SIDE * SIDE * SIDE }; /* over 2/3 of 8^7 */
    octree_point *points = malloc(COUNT * sizeof *points);
    assert_non_null(points);
    for (size_t i = 0; i < COUNT; i++)
        points[i] = (octree_point){{(double)(i % SIDE), (double)(i / SIDE % SIDE), (double)(i / SIDE / SIDE)}, i};
    octree *tree = make_tree(cube(0, SIDE), 1, 21, OCTREE_GROW);
    size_t inserted = 0;
    assert_int_equal(octree_insert_many(tree, points, COUNT, NULL, &inserted), OCTREE_OK);
    assert_int_equal(inserted, COUNT);
    assert_valid(tree);
    octree_destroy(tree);
    free(points);
}

/* Insert and remove equal points. The i-th id is i * factor mod count, a shuffle when the factor is large. */
static void grow_and_shrink(uint64_t count, uint64_t insert_factor, uint64_t remove_factor)
{
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 2, 21, OCTREE_GROW);
    const double at[3] = {0.3, 0.3, 0.3};
    for (uint64_t i = 0; i < count; i++)
        assert_true(octree_insert(tree, at, i * insert_factor % count) == OCTREE_OK);
    assert_int_equal(octree_count(tree), count);
    assert_int_equal(octree_insert(tree, at, count / 2), OCTREE_DUPLICATE);
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    assert_int_equal(stats.largest_leaf, count);
    assert_int_equal(stats.nodes, 22);
    assert_true(counts.bytes < 100 * count);
    assert_true(counts.peak < 200 * count);
    uint64_t lowest = 1;
    assert_int_equal(octree_find(tree, at, &lowest), OCTREE_OK);
    assert_true(lowest == 0);
    for (uint64_t i = 0; i < count; i++)
        assert_true(octree_remove(tree, at, i * remove_factor % count) == OCTREE_OK);
    assert_int_equal(octree_count(tree), 0);
    assert_true(counts.bytes < 1 << 20);
    assert_valid(tree);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static void a_million_equal_points_grow_one_leaf_in_linear_memory(void **state)
{
    (void)state;
    grow_and_shrink(million, 618033, 1);
    grow_and_shrink(50000, 1, 30903);
    grow_and_shrink(50000, 1, 1);
    grow_and_shrink(50000, 49999, 1); /* descending */
}

/* A million points at one place, numbered from 0, in memory to be freed. */
static octree_point *million_equal(void)
{
    octree_point *points = malloc(million * sizeof *points);
    assert_non_null(points);
    for (uint64_t id = 0; id < million; id++)
        points[id] = (octree_point){{0.3, 0.3, 0.3}, id};
    return points;
}

static void a_batch_of_a_million_equal_points_is_refused_but_for_a_leaf_of_them(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree_point *points = million_equal();
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 2, 21, OCTREE_REFUSE);
    size_t done = 0;
    assert_int_equal(octree_insert_many(tree, points, million, NULL, &done), OCTREE_OK);
    assert_int_equal(done, 2);
    assert_true(octree_contains(tree, points[0].position, 0) && octree_contains(tree, points[1].position, 1));
    assert_true(counts.peak < 200 * (size_t)million);
    assert_true(counts.bytes < 1 << 20);
    octree_destroy(tree);
    free(points);
    assert_all_returned(&counts);
}

static bool count_visit(const octree_point *point, void *context)
{
    (void)point;
    ++*(size_t *)context;
    return true;
}

/* Every query, of a tree that holds a million points at one place and nothing else. */
static void ask_a_million_equal_points(const octree *tree)
{
    const double at[3] = {0.3, 0.3, 0.3}, aside[3] = {0.3, 0.3, 0.55}, away[3] = {-1, -1, -1};
    const octree_box all = cube(-1, 1), there = cube(0.3, 0.3), beside = cube(-1, next_down(0.3));
    size_t count = 0, visits = 0;
    octree_neighbor nearest;
    assert_int_equal(octree_range_count(tree, &all, &count), OCTREE_OK);
    assert_int_equal(count, million);
    assert_int_equal(octree_range(tree, &there, count_visit, &visits), OCTREE_OK);
    assert_int_equal(octree_range(tree, &beside, count_visit, &visits), OCTREE_OK);
    assert_int_equal(octree_radius(tree, aside, 0.125, NULL, count_visit, &visits), OCTREE_OK);
    assert_int_equal(octree_radius(tree, aside, 0.5, NULL, count_visit, &visits), OCTREE_OK);
    assert_int_equal(octree_collide(tree, aside, 0.125, NULL, count_visit, &visits), OCTREE_OK);
    assert_int_equal(octree_collide_swept(tree, aside, away, 0.75, NULL, NULL, count_visit, &visits), OCTREE_OK);
    assert_int_equal(visits, 3 * million);
    assert_int_equal(octree_nearest(tree, aside, OCTREE_SKIP_NONE, 0, &nearest), OCTREE_OK); /* a million ties */
    assert_int_equal(nearest.point.id, 0);
    assert_int_equal(octree_nearest(tree, at, OCTREE_SKIP_COINCIDENT, 0, &nearest), OCTREE_NOT_FOUND);
}

static void a_batch_of_a_million_equal_points_grows_one_leaf_that_answers(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree_point *points = million_equal();
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 2, 21, OCTREE_GROW);
    size_t done = 0;
    octree_stats stats;
    assert_int_equal(octree_insert_many(tree, points, million, NULL, &done), OCTREE_OK);
    assert_int_equal(done, million);
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    assert_int_equal(stats.largest_leaf, million);
    assert_int_equal(stats.nodes, 22);
    assert_true(counts.bytes < 100 * (size_t)million);
    assert_true(counts.peak < 300 * (size_t)million);
    ask_a_million_equal_points(tree);
    assert_int_equal(octree_remove_many(tree, points, million, NULL, &done), OCTREE_OK);
    assert_int_equal(done, million);
    assert_int_equal(octree_count(tree), 0);
    octree_destroy(tree);
    free(points);
    assert_all_returned(&counts);
}

static void a_large_grown_leaf_passes_the_validator(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 2, 3, OCTREE_GROW);
    for (uint64_t i = 0; i < 50000; i++)
        assert_int_equal(octree_insert(tree, (double[3]){0.3, 0.3, 0.3}, i * 7919 % 50000), OCTREE_OK);
    assert_valid(tree);
    assert_true(octree_digest(tree) != 0);
    octree_destroy(tree);
}

static void a_million_uniform_points_take_less_than_a_hundred_bytes_each(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 16, 21, OCTREE_REFUSE);
    uint64_t random = 8;
    for (uint64_t id = 0; id < million; id++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = 2 * octree_random_unit(&random) - 1;
        assert_true(octree_insert(tree, at, id) == OCTREE_OK);
    }
    assert_true(counts.bytes < 100 * (size_t)million);
    const octree_point few[] = {{{0, 0, 0}, million}, {{0.5, 0, 0}, million + 1}, {{0, 0, 0}, million}};
    size_t inserted;
    assert_int_equal(octree_insert_many(tree, few, 3, NULL, &inserted), OCTREE_OK); /* one by one */
    assert_true(inserted == 2 && octree_count(tree) == million + 2);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static void *run_all(void *failed)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_million_equal_points_are_refused_without_taking_memory),
        cmocka_unit_test(more_points_than_the_finest_grid_has_cells_for_are_sorted),
        cmocka_unit_test(a_million_equal_points_grow_one_leaf_in_linear_memory),
        cmocka_unit_test(a_batch_of_a_million_equal_points_is_refused_but_for_a_leaf_of_them),
        cmocka_unit_test(a_batch_of_a_million_equal_points_grows_one_leaf_that_answers),
        cmocka_unit_test(a_large_grown_leaf_passes_the_validator),
        cmocka_unit_test(a_million_uniform_points_take_less_than_a_hundred_bytes_each),
    };
    *(int *)failed = cmocka_run_group_tests(tests, NULL, NULL);
    return NULL;
}

/* Set the size of a thread's stack: 64 KiB, or what the machine asks for at least. */
static bool use_little_stack(pthread_attr_t *attributes)
{
#if defined(OCTREEL_SANITIZED)
    (void)attributes;
    puts("The stack is as large as ever: what sanitizers add to it does not fit 64 KiB.");
    return true;
#else
    enum { KIBIBYTES = 64 };
#if defined(_SC_THREAD_STACK_MIN)
    const long least = sysconf(_SC_THREAD_STACK_MIN);
#else
    const long least = 0;
#endif
    const size_t size = least > KIBIBYTES * 1024 ? (size_t)least : KIBIBYTES * 1024;
    printf("All runs on %zu KiB of stack.\n", size / 1024);
    return pthread_attr_setstacksize(attributes, size) == 0;
#endif
}

/* The tests run in a thread of their own, whose stack ends in a page that must not be touched. */
int main(void)
{
    pthread_t thread;
    pthread_attr_t attributes;
    int failed = 1;
    if (pthread_attr_init(&attributes) != 0 || !use_little_stack(&attributes) ||
        pthread_create(&thread, &attributes, run_all, &failed) != 0 || pthread_join(thread, NULL) != 0) {
        fputs("test_million: there is no thread\n", stderr);
        return 2;
    }
    return failed;
}
