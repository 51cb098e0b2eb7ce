/* test_million.c - a million points, equal or not: linear memory, constant time a point. */
#include "fixture.h"

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
    octree_destroy(tree);
    assert_all_returned(&counts);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_million_equal_points_are_refused_without_taking_memory),
        cmocka_unit_test(a_million_equal_points_grow_one_leaf_in_linear_memory),
        cmocka_unit_test(a_large_grown_leaf_passes_the_validator),
        cmocka_unit_test(a_million_uniform_points_take_less_than_a_hundred_bytes_each),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
