/* SPDX-License-Identifier: MIT */
/* test_recorder_ring.c - a ring keeps the last ticks of a program until the program has them filmed. */
#include "fixture.h"

#include <fenv.h>
#include <string.h>

#include "film_again.h"
#include "moving_tree.h"

enum { TICKS = 60 };

/* Record all ticks and store the digests of their trees. */
static void record_all(octreel_recorder *recorder, moving_tree *m, uint64_t digests[TICKS])
{
    for (int tick = 0; tick < TICKS; tick++) {
        assert_recorded(recorder, m);
        digests[tick] = octree_digest(m->tree);
        moving_tree_step(m);
    }
}

static void assert_written(octreel_recorder *recorder, const place *folder, uint64_t first)
{
    uint64_t found = UINT64_MAX;
    if (octreel_recorder_write(recorder, folder->path, &found) != OCTREEL_OK)
        fail_msg("%s", octreel_recorder_error(recorder));
    assert_int_equal(found, first);
}

static void assert_tells(const place *folder, const uint64_t *digests, size_t count)
{
    uint64_t told[TICKS];
    assert_int_equal(tree_digests(folder->path, told, TICKS), count);
    assert_memory_equal(told, digests, count * sizeof *told);
}

static void check_ring(void **state, octree_full_leaf full_leaf, size_t size)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    const size_t count = size < TICKS ? size : TICKS;
    uint64_t digests[TICKS];
    moving_tree m;
    moving_tree_make(&m, full_leaf, size);
    octreel_recorder_def def = small_recorder(&m, NULL);
    def.ring = size;
    octreel_recorder *recorder = open_recorder(&def);
    record_all(recorder, &m, digests);
    assert_written(recorder, &folder, TICKS - count);
    close_recorder(recorder);
    moving_tree_release(&m);
    assert_tells(&folder, digests + TICKS - count, count);
    assert_films_again(&folder, &again, count);
}

static void ring_has_the_last_ticks_and_replays_to_the_same_bytes(void **state)
{
    check_ring(state, OCTREE_GROW, 13);
}

static void ring_of_trees_that_refuse_points_replays_to_the_same_bytes(void **state)
{
    check_ring(state, OCTREE_REFUSE, 20);
}

/* All points have left the tree. */
static void ring_of_an_empty_tree_replays_to_the_same_bytes(void **state)
{
    check_ring(state, OCTREE_REFUSE, 2);
}

static void ring_of_one_tick_has_the_last_tick(void **state)
{
    check_ring(state, OCTREE_GROW, 1);
}

static void ring_that_is_not_full_has_all_ticks(void **state)
{
    check_ring(state, OCTREE_REFUSE, TICKS + 1);
}

static void ring_records_the_same_as_a_recorder_without_a_ring(void **state)
{
    const place ring = place_in(*state, "ring"), live = place_in(*state, "live");
    uint64_t digests[TICKS];
    for (int i = 0; i < 2; i++) {
        moving_tree m;
        moving_tree_make(&m, OCTREE_GROW, 9);
        octreel_recorder_def def = small_recorder(&m, live.path);
        def.ring = i ? TICKS : 0;
        def.player = (octree_player){.kind = OCTREE_PLAYER_BODY, .id = m.points[0].id, .box_size = 3, .sweep = true};
        octreel_recorder *recorder = open_recorder(&def);
        record_all(recorder, &m, digests);
        if (i)
            assert_written(recorder, &ring, 0);
        close_recorder(recorder);
        moving_tree_release(&m);
    }
    assert_same_folders(ring.path, live.path, NULL);
}

/* A program may write its ring more than once, for example at each failed assertion, and in any rounding mode. */
static void ring_continues_after_it_was_written(void **state)
{
    const place first = place_in(*state, "first"), second = place_in(*state, "second");
    const place again = place_in(*state, "again");
    uint64_t digests[TICKS];
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 3);
    octreel_recorder_def def = small_recorder(&m, NULL);
    def.ring = 10;
    octreel_recorder *recorder = open_recorder(&def);
    record_all(recorder, &m, digests);
    assert_int_equal(fesetround(FE_UPWARD), 0);
    const octreel_status written = octreel_recorder_write(recorder, first.path, NULL);
    assert_int_equal(fesetround(FE_TONEAREST), 0);
    assert_int_equal(written, OCTREEL_OK);
    assert_int_equal(octreel_recorder_write(recorder, first.path, NULL), OCTREEL_BAD_FOLDER);
    record_steps(recorder, &m, 1); /* two steps after the last tick */
    assert_written(recorder, &second, TICKS + 1 - 10);
    assert_tells(&first, digests + TICKS - 10, 10);
    digests[0] = octree_digest(m.tree);
    close_recorder(recorder);
    moving_tree_release(&m);
    uint64_t told[TICKS];
    assert_int_equal(tree_digests(second.path, told, TICKS), 10);
    assert_memory_equal(told, digests + TICKS - 9, 9 * sizeof *told);
    assert_true(told[9] == digests[0]);
    assert_films_again(&second, &again, 10);
}

static void ring_without_a_tick_or_a_folder_is_an_error(void **state)
{
    const place folder = place_in(*state, "film");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 3);
    octreel_recorder_def def = small_recorder(&m, NULL);
    def.ring = 10;
    octreel_recorder *recorder = open_recorder(&def);
    assert_int_equal(octreel_recorder_write(recorder, folder.path, NULL), OCTREEL_NOTHING);
    assert_recorded(recorder, &m);
    assert_int_equal(octreel_recorder_write(recorder, NULL, NULL), OCTREEL_NULL_ARGUMENT);
    close_recorder(recorder);
    assert_false(file_exists(folder.path));
    moving_tree_release(&m);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(ring_has_the_last_ticks_and_replays_to_the_same_bytes),
        TEST(ring_of_trees_that_refuse_points_replays_to_the_same_bytes),
        TEST(ring_of_an_empty_tree_replays_to_the_same_bytes),
        TEST(ring_of_one_tick_has_the_last_tick),
        TEST(ring_that_is_not_full_has_all_ticks),
        TEST(ring_records_the_same_as_a_recorder_without_a_ring),
        TEST(ring_continues_after_it_was_written),
        TEST(ring_without_a_tick_or_a_folder_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
