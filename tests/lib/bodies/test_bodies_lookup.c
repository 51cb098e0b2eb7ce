/* SPDX-License-Identifier: MIT */
/* test_bodies_lookup.c - bodies are found with and without the hash table of a set, which octree_bodies_memory() shows.
 */
#include "fixture.h"

#include "body_sets.h"
#include "counting_allocator.h"
#include "octree/sample.h"

enum { BODIES = 5000, MANY = BODIES / 2, CROWD = 3000, SLOT = 8 };

static octree_bodies *make_full_set(octree_body *bodies)
{
    uint64_t seed = 1;
    octree_bodies *set = make_body_set(cube(-8, 8), 16);
    for (uint64_t i = 0; i < BODIES; i++)
        bodies[i] = small_body(0.1, &seed, i);
    assert_int_equal(octree_bodies_insert_many(set, bodies, BODIES, NULL, NULL), OCTREE_OK);
    return set;
}

/* Make an empty set whose memory is counted. */
static octree_bodies *make_counted_set(counting_allocator *counts)
{
    octree_bodies *set;
    octree_def def = define(cube(-8, 8), 16, 21, OCTREE_GROW);
    def.allocator = counting_allocator_use(counts);
    assert_int_equal(octree_bodies_create(&def, &set), OCTREE_OK);
    return set;
}

static void assert_finds_all(const octree_bodies *set, const octree_body *bodies, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        octree_body other = bodies[i];
        assert_true(octree_bodies_contain(set, &other));
        other.half[1] += 0.001;
        assert_false(octree_bodies_contain(set, &other));
    }
    assert_null(octree_bodies_check(set));
}

static void bulk_changes_keep_no_table(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    octree_bodies *set = make_full_set(bodies);
    const size_t lean = octree_bodies_memory(set);
    assert_finds_all(set, bodies, BODIES);
    assert_int_equal(octree_bodies_remove(set, &bodies[7]), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(set, &bodies[7]), OCTREE_OK);
    assert_true(octree_bodies_memory(set) < lean + BODIES);
    assert_int_equal(octree_bodies_remove(set, &bodies[8]), OCTREE_OK); /* a free row is not copied */
    assert_int_equal(octree_bodies_remove_many(set, &bodies[9], MANY, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_bodies_insert_many(set, &bodies[9], MANY, NULL, NULL), OCTREE_OK);
    assert_true(octree_bodies_memory(set) < lean + BODIES);
    assert_false(octree_bodies_contain(set, &bodies[8]));
    assert_int_equal(octree_bodies_insert(set, &bodies[8]), OCTREE_OK);
    assert_finds_all(set, bodies, BODIES);
    assert_int_equal(octree_bodies_insert(set, &bodies[9]), OCTREE_DUPLICATE);
    assert_int_equal(octree_bodies_compact(set), OCTREE_OK);
    assert_true(octree_bodies_memory(set) < lean + BODIES);
    assert_finds_all(set, bodies, BODIES);
    octree_bodies_destroy(set);
}

/* They would fill the set anew otherwise, because a share of nothing is nothing. */
static void bulk_changes_of_nothing_allocate_nothing(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree_bodies *set = make_counted_set(&counts);
    octree_status status;
    const octree_body body = body_at(1, 2, 3, 0.05, 7);
    const size_t before = counts.calls;
    assert_int_equal(octree_bodies_insert_many(set, NULL, 0, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_bodies_remove_many(set, NULL, 0, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_bodies_move_many(set, NULL, NULL, 0, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_bodies_remove_many(set, &body, 1, &status, NULL), OCTREE_OK);
    assert_int_equal(status, OCTREE_NOT_FOUND);
    assert_int_equal(counts.calls, before);
    octree_bodies_destroy(set);
    assert_all_returned(&counts);
}

/* A table would take time and memory for all bodies. */
static void few_changes_in_one_call_need_no_table(void **state)
{
    (void)state;
    enum { FEW = 100 };
    static octree_body bodies[BODIES];
    octree_body moved[FEW];
    octree_status statuses[FEW];
    size_t changed = 7;
    octree_bodies *set = make_full_set(bodies);
    const size_t lean = octree_bodies_memory(set);
    for (size_t i = 0; i < FEW; i++) {
        moved[i] = bodies[i];
        moved[i].position[0] = -moved[i].position[0];
    }
    assert_int_equal(octree_bodies_move_many(set, bodies, moved, FEW, statuses, &changed), OCTREE_OK);
    assert_int_equal(changed, FEW);
    assert_int_equal(octree_bodies_remove_many(set, bodies, FEW, statuses, &changed), OCTREE_OK);
    assert_int_equal(changed, 0);
    assert_int_equal(statuses[FEW - 1], OCTREE_NOT_FOUND);
    assert_int_equal(octree_bodies_remove_many(set, moved, FEW / 2, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_bodies_insert_many(set, moved, FEW, statuses, &changed), OCTREE_OK);
    assert_int_equal(changed, FEW / 2);
    assert_int_equal(statuses[FEW - 1], OCTREE_DUPLICATE);
    assert_true(octree_bodies_memory(set) < lean + BODIES);
    assert_finds_all(set, moved, FEW);
    assert_finds_all(set, bodies + FEW, BODIES - FEW);
    octree_bodies_destroy(set);
}

/* The bodies whose status is OK are changed, and the call tells that others are not. */
static void few_changes_without_memory_report_it(void **state)
{
    (void)state;
    enum { FEW = 300 };
    static octree_body bodies[BODIES];
    octree_body added[FEW];
    octree_status statuses[FEW];
    counting_allocator counts = {0};
    octree_bodies *set = make_counted_set(&counts);
    uint64_t seed = 2;
    size_t changed, kept = 0;
    for (uint64_t i = 0; i < BODIES; i++)
        bodies[i] = small_body(0.1, &seed, i);
    for (uint64_t i = 0; i < FEW; i++)
        added[i] = small_body(0.1, &seed, BODIES + i);
    assert_int_equal(octree_bodies_insert_many(set, bodies, BODIES, NULL, NULL), OCTREE_OK);
    counting_allocator_fail_at(&counts, 0);
    counts.fail_until = SIZE_MAX;
    assert_int_equal(octree_bodies_insert_many(set, added, FEW, statuses, &changed), OCTREE_NO_MEMORY);
    counting_allocator_stop_failing(&counts);
    for (size_t i = 0; i < FEW; i++) {
        assert_int_equal(octree_bodies_contain(set, &added[i]), statuses[i] == OCTREE_OK);
        kept += statuses[i] == OCTREE_OK;
    }
    assert_true(changed == kept && kept > 0 && kept < FEW);
    assert_null(octree_bodies_check(set));
    octree_bodies_destroy(set);
    assert_all_returned(&counts);
}

/* Bodies at one place, which differ in their ids. */
static void make_crowd(octree_body crowd[CROWD])
{
    for (uint64_t i = 0; i < CROWD; i++)
        crowd[i] = body_at(1, 2, 3, 0.05, BODIES + i);
}

static void crowds_are_found_by_a_table(void **state)
{
    (void)state;
    static octree_body bodies[BODIES], crowd[CROWD];
    octree_bodies *set = make_full_set(bodies);
    make_crowd(crowd);
    for (size_t i = 0; i < CROWD; i++) {
        assert_int_equal(octree_bodies_insert(set, &crowd[i]), OCTREE_OK);
        assert_int_equal(octree_bodies_insert(set, &crowd[i / 2]), OCTREE_DUPLICATE);
    }
    assert_int_equal(octree_bodies_remove_many(set, bodies, BODIES, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_bodies_insert_many(set, bodies, BODIES, NULL, NULL), OCTREE_OK);
    assert_finds_all(set, crowd, CROWD);
    for (size_t i = 0; i < CROWD; i += 2)
        assert_int_equal(octree_bodies_remove(set, &crowd[i]), OCTREE_OK);
    for (size_t i = 0; i < CROWD; i++)
        assert_int_equal(octree_bodies_contain(set, &crowd[i]), i % 2);
    assert_finds_all(set, bodies, BODIES);
    octree_bodies_destroy(set);
}

/* A crowd is one body larger than a leaf that is searched without a table, and there is no memory for a table. */
static void crowds_are_found_without_memory_for_a_table(void **state)
{
    (void)state;
    enum { MOST = 65 };
    counting_allocator counts = {0};
    octree_bodies *set = make_counted_set(&counts);
    octree_body crowd[MOST];
    for (uint64_t i = 0; i < MOST; i++) {
        crowd[i] = body_at(1, 2, 3, 0.05, i);
        assert_int_equal(octree_bodies_insert(set, &crowd[i]), OCTREE_OK);
    }
    assert_finds_all(set, crowd, MOST);
    counting_allocator_fail_at(&counts, 0);
    counts.fail_until = SIZE_MAX;
    assert_int_equal(octree_bodies_remove(set, &crowd[MOST - 1]), OCTREE_OK);
    counting_allocator_stop_failing(&counts);
    assert_false(octree_bodies_contain(set, &crowd[MOST - 1]));
    assert_finds_all(set, crowd, MOST - 1);
    octree_bodies_destroy(set);
    assert_all_returned(&counts);
}

static void crowds_of_a_first_insertion_keep_the_table(void **state)
{
    (void)state;
    static octree_body crowd[CROWD];
    octree_bodies *set = make_body_set(cube(-8, 8), 16);
    make_crowd(crowd);
    assert_int_equal(octree_bodies_insert_many(set, crowd, CROWD, NULL, NULL), OCTREE_OK);
    const size_t bytes = octree_bodies_memory(set);
    const octree_body moved = body_at(2, 2, 2, 0.05, BODIES);
    assert_int_equal(octree_bodies_move(set, &crowd[0], &moved), OCTREE_OK);
    assert_int_equal(octree_bodies_move(set, &crowd[0], &moved), OCTREE_NOT_FOUND);
    assert_int_equal(octree_bodies_move(set, &moved, &crowd[1]), OCTREE_DUPLICATE);
    assert_true(octree_bodies_memory(set) < bytes + SLOT * CROWD);
    assert_finds_all(set, crowd + 1, CROWD - 1);
    octree_bodies_destroy(set);
}

/* Insert bodies into an empty set, in one call and one by one, and compare the statuses. */
static void assert_statuses_of_first_insertion(const octree_body *bodies, size_t count)
{
    static octree_status statuses[BODIES];
    size_t changed;
    octree_bodies *bulk = make_body_set(cube(-8, 8), 16), *single = make_body_set(cube(-8, 8), 16);
    assert_int_equal(octree_bodies_insert_many(bulk, bodies, count, statuses, &changed), OCTREE_OK);
    for (size_t i = 0; i < count; i++)
        assert_int_equal(statuses[i], octree_bodies_insert(single, &bodies[i]));
    assert_int_equal(changed, octree_bodies_count(single));
    assert_true(octree_bodies_digest(bulk) == octree_bodies_digest(single));
    assert_null(octree_bodies_check(bulk));
    octree_bodies_destroy(bulk);
    octree_bodies_destroy(single);
}

static void a_first_insertion_finds_repeated_bodies_in_sparse_cells(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    uint64_t seed = 5;
    for (uint64_t i = 0; i < BODIES; i++)
        bodies[i] = small_body(0.1, &seed, i);
    for (size_t i = 0; i < BODIES / 4; i++)
        bodies[BODIES - 1 - 3 * i] = bodies[i];
    for (size_t i = 0; i < 50; i += 10) { /* at the corner of eight cells, with other signs, ids and half extents */
        bodies[i] = bodies[i + 1] = bodies[i + 2] = bodies[i + 3] = body_at(0, 0, 0, 0.05, i);
        bodies[i + 1].position[1] = bodies[i + 1].half[0] = -0.0;
        bodies[i + 2].position[2] = -0.0;
        bodies[i + 3].half[2] = 0.06;
        bodies[i + 4] = body_at(9, 0, 0, 0.05, i); /* outside */
    }
    assert_statuses_of_first_insertion(bodies, BODIES);
}

static void a_first_insertion_finds_repeated_bodies_in_dense_cells(void **state)
{
    (void)state;
    enum { MOST = 40 };
    octree_body bodies[2 * MOST];
    for (size_t count = MOST / 2; count <= MOST; count++) {
        for (uint64_t i = 0; i < count; i++)
            bodies[i] = bodies[2 * count - 1 - i] = body_at(1 + 0.001 * (double)i, 1, 1, 0.05, i);
        assert_statuses_of_first_insertion(bodies, 2 * count);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bulk_changes_keep_no_table),
        cmocka_unit_test(bulk_changes_of_nothing_allocate_nothing),
        cmocka_unit_test(few_changes_in_one_call_need_no_table),
        cmocka_unit_test(few_changes_without_memory_report_it),
        cmocka_unit_test(crowds_are_found_by_a_table),
        cmocka_unit_test(crowds_are_found_without_memory_for_a_table),
        cmocka_unit_test(crowds_of_a_first_insertion_keep_the_table),
        cmocka_unit_test(a_first_insertion_finds_repeated_bodies_in_sparse_cells),
        cmocka_unit_test(a_first_insertion_finds_repeated_bodies_in_dense_cells),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
