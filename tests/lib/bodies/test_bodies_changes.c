/* SPDX-License-Identifier: MIT */
/* test_bodies_changes.c - long random sequences of single and bulk changes against a list of bodies, and failures of
 * each allocation. */
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

#include "body_model.h"
#include "body_scenes.h"
#include "counting_allocator.h"

enum { ROUNDS = 400 };

static void changes_have_the_result_of_changes_of_a_list(void **state)
{
    (void)state;
    for (int numbers = 0; numbers < NUMBERS_KINDS; numbers++) {
        uint64_t seed = 11 + (uint64_t)numbers;
        body_model m = {.count = 0};
        octree_bodies *set;
        const octree_def def = define(scene_world((scene_numbers)numbers), 3, 21, OCTREE_GROW);
        assert_int_equal(octree_bodies_create(&def, &set), OCTREE_OK);
        for (int round = 0; round < ROUNDS; round++) {
            if (random_below(&seed, 8) == 0)
                body_model_change_many(set, &m, (scene_numbers)numbers, &seed);
            else
                body_model_change_one(set, &m, (scene_numbers)numbers, &seed);
            if (random_below(&seed, 50) == 0)
                body_model_compact(set, &m);
            if (round % 16 == 0)
                body_model_assert_same(set, &m);
        }
        assert_int_equal(octree_bodies_replace_all(set, m.bodies, m.count / 2, NULL, NULL), OCTREE_OK);
        m.count /= 2;
        body_model_assert_same(set, &m);
        assert_int_equal(octree_bodies_clear(set), OCTREE_OK);
        m.count = 0;
        body_model_assert_same(set, &m);
        octree_bodies_destroy(set);
    }
}

/* Bodies at one place: each change takes constant time, so that this test is quick. */
static void many_bodies_at_one_place_are_changed_quickly(void **state)
{
    (void)state;
    enum { MANY = 100000 };
    octree_bodies *set;
    const octree_def def = define(cube(-8, 8), 4, 21, OCTREE_GROW);
    octree_body body = {{1, 1, 1}, {1, 1, 1}, 0};
    assert_int_equal(octree_bodies_create(&def, &set), OCTREE_OK);
    for (body.id = 0; body.id < MANY; body.id++)
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    for (body.id = 0; body.id < MANY; body.id += 2) {
        octree_body moved = body;
        moved.half[0] = 1.25;
        assert_int_equal(octree_bodies_move(set, &body, &moved), OCTREE_OK);
    }
    for (body.id = 1; body.id < MANY; body.id += 2)
        assert_int_equal(octree_bodies_remove(set, &body), OCTREE_OK);
    assert_int_equal(octree_bodies_count(set), MANY / 2);
    octree_bodies_destroy(set);
}

/* ---- Failures of memory ------------------------------------------------------------------------------------- */

typedef octree_status change_set(octree_bodies *set, const octree_body *from, const octree_body *to, size_t count);

static octree_status insert_each(octree_bodies *set, const octree_body *from, const octree_body *to, size_t count)
{
    (void)from;
    return octree_bodies_insert(set, &to[count - 1]);
}

static octree_status remove_each(octree_bodies *set, const octree_body *from, const octree_body *to, size_t count)
{
    (void)to;
    return octree_bodies_remove(set, &from[count - 1]);
}

static octree_status move_each(octree_bodies *set, const octree_body *from, const octree_body *to, size_t count)
{
    return octree_bodies_move(set, &from[count - 1], &to[count - 1]);
}

static octree_status compact(octree_bodies *set, const octree_body *from, const octree_body *to, size_t count)
{
    (void)from;
    (void)to;
    (void)count;
    return octree_bodies_compact(set);
}

static octree_status replace_all(octree_bodies *set, const octree_body *from, const octree_body *to, size_t count)
{
    (void)from;
    return octree_bodies_replace_all(set, to, count, NULL, NULL);
}

/* Make a set of `count` bodies whose memory is counted, and as many destinations. */
static octree_bodies *make_counted_set(counting_allocator *counts, octree_body *from, octree_body *to, size_t count)
{
    uint64_t seed = 77;
    octree_bodies *set;
    octree_def def = define(scene_world(NUMBERS_SMOOTH), 2, 21, OCTREE_GROW);
    def.allocator = counting_allocator_use(counts);
    assert_int_equal(octree_bodies_create(&def, &set), OCTREE_OK);
    for (size_t i = 0; i < count; i++) {
        from[i] = random_body(NUMBERS_SMOOTH, &seed, i);
        to[i] = random_body(NUMBERS_SMOOTH, &seed, i);
        assert_int_equal(octree_bodies_insert(set, &from[i]), OCTREE_OK);
    }
    return set;
}

/* Let allocation n and all later ones fail, for n = 0, 1, 2 ..., until the change succeeds. A failure changes nothing.
 * Returns the number of failures. */
static size_t assert_failures_change_nothing(change_set *change)
{
    size_t failures = 0;
    for (size_t count = 1; count <= 48; count++) {
        octree_body from[48], to[48];
        counting_allocator counts = {0};
        octree_bodies *set = make_counted_set(&counts, from, to, count);
        octree_status status = OCTREE_NO_MEMORY;
        for (size_t n = 0; status == OCTREE_NO_MEMORY; n++) {
            const uint64_t digest = octree_bodies_digest(set);
            counting_allocator_fail_at(&counts, n);
            counts.fail_until = SIZE_MAX;
            status = change(set, from, to, count);
            counting_allocator_stop_failing(&counts);
            assert_true(status == OCTREE_OK || status == OCTREE_NO_MEMORY);
            assert_null(octree_bodies_check(set));
            assert_true(status == OCTREE_OK || octree_bodies_digest(set) == digest);
            failures += status == OCTREE_NO_MEMORY;
        }
        octree_bodies_destroy(set);
        assert_all_returned(&counts);
    }
    return failures;
}

static void single_changes_survive_the_failure_of_each_allocation(void **state)
{
    (void)state;
    assert_true(assert_failures_change_nothing(insert_each) > 0);
    assert_failures_change_nothing(remove_each); /* merges find free blocks */
    assert_true(assert_failures_change_nothing(move_each) > 0);
    assert_true(assert_failures_change_nothing(compact) > 0);
    assert_true(assert_failures_change_nothing(replace_all) > 0);
}

typedef octree_status change_many_bodies(octree_bodies *set, const octree_body *from, const octree_body *to,
                                         size_t count, octree_status *statuses);

static octree_status insert_many(octree_bodies *set, const octree_body *from, const octree_body *to, size_t count,
                                 octree_status *statuses)
{
    (void)from;
    return octree_bodies_insert_many(set, to, count, statuses, NULL);
}

static octree_status remove_many(octree_bodies *set, const octree_body *from, const octree_body *to, size_t count,
                                 octree_status *statuses)
{
    (void)to;
    return octree_bodies_remove_many(set, from, count, statuses, NULL);
}

static octree_status move_many(octree_bodies *set, const octree_body *from, const octree_body *to, size_t count,
                               octree_status *statuses)
{
    return octree_bodies_move_many(set, from, to, count, statuses, NULL);
}

/* The statuses of a bulk call for which memory runs out say which bodies are changed, whether it fails or makes single
 * changes instead. `removes`: it removes `from`; `inserts`: it inserts `to`. */
static void assert_statuses_are_true(change_many_bodies *change, bool removes, bool inserts)
{
    enum { COUNT = 48 };
    octree_status status = OCTREE_NO_MEMORY;
    bool failed = true;
    size_t n = 0;
    for (; failed; n++) {
        octree_body from[COUNT], to[COUNT];
        octree_status statuses[COUNT];
        counting_allocator counts = {0};
        octree_bodies *set = make_counted_set(&counts, from, to, COUNT);
        for (size_t i = 0; i < COUNT; i++)
            statuses[i] = OCTREE_OK;
        counting_allocator_fail_at(&counts, n);
        counts.fail_until = SIZE_MAX;
        status = change(set, from, to, COUNT, statuses);
        failed = counts.calls > counts.fail_from;
        counting_allocator_stop_failing(&counts);
        assert_null(octree_bodies_check(set));
        for (size_t i = 0; i < COUNT; i++) {
            assert_true(statuses[i] == OCTREE_OK || statuses[i] == OCTREE_NO_MEMORY);
            assert_true(octree_bodies_contain(set, &from[i]) == !(removes && statuses[i] == OCTREE_OK));
            assert_true(octree_bodies_contain(set, &to[i]) == (inserts && statuses[i] == OCTREE_OK));
        }
        octree_bodies_destroy(set);
        assert_all_returned(&counts);
    }
    assert_int_equal(status, OCTREE_OK);
    assert_true(n > 3);
}

static void bulk_changes_report_what_a_failure_has_changed(void **state)
{
    (void)state;
    assert_statuses_are_true(insert_many, false, true);
    assert_statuses_are_true(remove_many, true, false);
    assert_statuses_are_true(move_many, true, true);
}

/* Bodies of two sizes, as many as the leaves of two levels hold, and one more in the first: a body that changes its
 * size makes one leaf merge and the other split. Leaves above 64 points are allocated by the caller's allocator. */
static void assert_resizing_is_whole(size_t capacity)
{
    octree_status status = OCTREE_NO_MEMORY;
    for (size_t n = 0; status == OCTREE_NO_MEMORY; n++) {
        uint64_t seed = 5;
        counting_allocator counts = {0};
        octree_bodies *set;
        octree_body first = {.id = 0}, body;
        octree_def def = define(cube(-1000, 1000), capacity, 21, OCTREE_GROW);
        def.allocator = counting_allocator_use(&counts);
        assert_int_equal(octree_bodies_create(&def, &set), OCTREE_OK);
        for (size_t i = 0; i <= 2 * capacity; i++) {
            body = (octree_body){.id = i};
            for (int axis = 0; axis < 3; axis++) {
                body.position[axis] = random_between(&seed, -1000, 1000);
                body.half[axis] = i <= capacity ? 1 : 900;
            }
            first = i == 0 ? body : first;
            assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
        }
        const uint64_t digest = octree_bodies_digest(set);
        body = first;
        body.half[0] = body.half[1] = body.half[2] = 900;
        counting_allocator_fail_at(&counts, n);
        counts.fail_until = SIZE_MAX;
        status = octree_bodies_move(set, &first, &body);
        counting_allocator_stop_failing(&counts);
        assert_null(octree_bodies_check(set));
        assert_true(status == OCTREE_OK || octree_bodies_digest(set) == digest);
        octree_bodies_destroy(set);
        assert_all_returned(&counts);
    }
    assert_int_equal(status, OCTREE_OK);
}

static void a_body_that_changes_its_level_is_never_in_both(void **state)
{
    (void)state;
    assert_resizing_is_whole(1);
    assert_resizing_is_whole(64);
    assert_resizing_is_whole(65);
    assert_resizing_is_whole(200);
}

/* A failed call of octree_bodies_replace_all() has changed nothing, and says so. */
static void a_failed_replacement_reports_no_change(void **state)
{
    (void)state;
    octree_status status = OCTREE_NO_MEMORY, statuses[48];
    for (size_t n = 0; status == OCTREE_NO_MEMORY; n++) {
        size_t changed = 99;
        octree_body from[48], to[48];
        counting_allocator counts = {0};
        octree_bodies *set = make_counted_set(&counts, from, to, 48);
        for (size_t i = 0; i < 48; i++)
            statuses[i] = OCTREE_OK;
        counting_allocator_fail_at(&counts, n);
        counts.fail_until = SIZE_MAX;
        status = octree_bodies_replace_all(set, to, 48, statuses, &changed);
        counting_allocator_stop_failing(&counts);
        assert_int_equal(changed, status == OCTREE_OK ? 48 : 0);
        for (size_t i = 0; i < 48; i++)
            assert_int_equal(statuses[i], status);
        octree_bodies_destroy(set);
        assert_all_returned(&counts);
    }
}

/* One body of a batch changes its level. If its move fails, the call does not return OK. */
static void a_batch_with_a_failed_move_returns_its_status(void **state)
{
    (void)state;
    size_t failed = 0;
    for (size_t n = 0; n < 40; n++) {
        octree_body from[4], to[4];
        octree_status statuses[4] = {OCTREE_OK, OCTREE_OK, OCTREE_OK, OCTREE_OK};
        counting_allocator counts = {0};
        octree_bodies *set = make_counted_set(&counts, from, to, 4);
        memcpy(to, from, sizeof to);
        to[2].half[0] = to[2].half[0] > 1 ? 0.001 : 8;
        to[2].half[1] = to[2].half[2] = to[2].half[0];
        counting_allocator_fail_at(&counts, n);
        counts.fail_until = SIZE_MAX;
        const octree_status status = octree_bodies_move_many(set, from, to, 4, statuses, NULL);
        counting_allocator_stop_failing(&counts);
        for (int i = 0; i < 4; i++)
            assert_true(status != OCTREE_OK || statuses[i] == OCTREE_OK);
        failed += status == OCTREE_NO_MEMORY;
        octree_bodies_destroy(set);
        assert_all_returned(&counts);
    }
    assert_true(failed > 3);
}

static bool ignore_pair(const octree_body *a, const octree_body *b, void *context)
{
    (void)a;
    (void)b;
    (void)context;
    return true;
}

static void pairs_and_creation_survive_the_failure_of_each_allocation(void **state)
{
    (void)state;
    octree_body from[48], to[48];
    counting_allocator counts = {0};
    octree_bodies *set = make_counted_set(&counts, from, to, 48), *other;
    octree_status status = OCTREE_NO_MEMORY;
    for (size_t n = 0; status == OCTREE_NO_MEMORY; n++) {
        counting_allocator_fail_at(&counts, n);
        status = octree_bodies_pairs(set, NULL, ignore_pair, NULL);
        counting_allocator_stop_failing(&counts);
        assert_true(n > 3 || status == OCTREE_NO_MEMORY);
    }
    assert_int_equal(status, OCTREE_OK);
    const octree_def def = octree_bodies_definition(set);
    for (size_t n = 0; n < 2; n++) {
        counting_allocator_fail_at(&counts, n);
        assert_int_equal(octree_bodies_create(&def, &other), OCTREE_NO_MEMORY);
        assert_null(other);
    }
    octree_bodies_destroy(set);
    assert_all_returned(&counts);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changes_have_the_result_of_changes_of_a_list),
        cmocka_unit_test(many_bodies_at_one_place_are_changed_quickly),
        cmocka_unit_test(single_changes_survive_the_failure_of_each_allocation),
        cmocka_unit_test(bulk_changes_report_what_a_failure_has_changed),
        cmocka_unit_test(a_body_that_changes_its_level_is_never_in_both),
        cmocka_unit_test(a_failed_replacement_reports_no_change),
        cmocka_unit_test(a_batch_with_a_failed_move_returns_its_status),
        cmocka_unit_test(pairs_and_creation_survive_the_failure_of_each_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
