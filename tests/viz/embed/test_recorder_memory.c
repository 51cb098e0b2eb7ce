/* SPDX-License-Identifier: MIT */
/* test_recorder_memory.c - if the n-th allocation of a call fails, for n = 0, 1, 2 ..., the call reports it and nothing
 * is lost. Then the same for the thread that films. */
#include "fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "failing_memory.h"
#include "film_again.h"
#include "files.h"
#include "moving_tree.h"

enum { BEFORE = 4, TICKS = 8 };

static octree_full_leaf full_leaf_of(moving_tree_source source)
{
    return source == MOVING_TREE ? OCTREE_REFUSE : OCTREE_GROW;
}

/* Record, and let one call succeed in no more than `count` allocations. A refused call is repeated, which makes two
 * ticks of it. False if no allocation failed. */
static bool record_with_failure(octreel_recorder *recorder, moving_tree_source source, long count,
                                uint64_t digests[TICKS + 1], bool *refused)
{
    moving_tree m;
    moving_edits edits = {.count = 0};
    bool failed = false;
    *refused = false;
    moving_tree_make(&m, full_leaf_of(source), 11);
    for (int tick = 0; tick < TICKS; tick++) {
        if (tick == BEFORE) {
            for (int i = 0; i < 20; i++)
                moving_tree_step(&m); /* so that the arrays may have to grow */
            moving_edits_make(&edits, &m);
            fail_allocations_after(count);
            const octreel_status status = record_tick_from(recorder, &m, source, &edits);
            failed = memory_has_failed();
            *refused = status == OCTREEL_NO_MEMORY;
            assert_true(status == OCTREEL_OK || (failed && *refused));
            digests[tick] = 0;
        } else
            moving_edits_make(&edits, &m);
        if (tick != BEFORE || *refused)
            assert_int_equal(record_tick_from(recorder, &m, source, &edits), OCTREEL_OK);
        digests[tick + *refused] = octree_digest(m.tree);
        moving_tree_step(&m);
    }
    moving_tree_release(&m);
    return failed;
}

/* The definition of this test's recorder, for the tree of a moving_tree. */
static octreel_recorder_def definition(const char *folder, moving_tree_source source, size_t ring)
{
    moving_tree m;
    moving_tree_make(&m, full_leaf_of(source), 11);
    octreel_recorder_def def = small_recorder(&m, folder);
    def.ring = ring;
    moving_tree_release(&m);
    return def;
}

static void check_ticks(void **state, moving_tree_source source, size_t ring)
{
    bool failed = true, refused, ever = false;
    long count = 0;
    for (; failed; count++) {
        char name[32];
        uint64_t digests[TICKS + 1], told[TICKS + 1];
        snprintf(name, sizeof name, "film%d-%ld", (int)source, count);
        const place folder = place_in(*state, name);
        const octreel_recorder_def def = definition(folder.path, source, ring);
        octreel_recorder *recorder = open_recorder(&def);
        failed = record_with_failure(recorder, source, count, digests, &refused);
        ever |= refused;
        if (ring)
            assert_int_equal(octreel_recorder_write(recorder, folder.path, NULL), OCTREEL_OK);
        assert_int_equal(octreel_recorder_close(recorder), refused ? OCTREEL_GAPS : OCTREEL_OK);
        octreel_recorder_destroy(recorder);
        const size_t ticks = TICKS + refused, kept = ring ? ring : ticks;
        assert_int_equal(tree_digests(folder.path, told, ticks), kept);
        assert_memory_equal(told, digests + ticks - kept, kept * sizeof *told);
    }
    assert_true(count > 3 && ever);
}

static void tick_without_memory_is_a_gap_and_can_be_repeated(void **state)
{
    check_ticks(state, MOVING_TREE, 0);
    check_ticks(state, MOVING_LIST, 0);
    check_ticks(state, MOVING_CHANGES, 0);
}

static void ring_without_memory_is_unchanged(void **state)
{
    check_ticks(state, MOVING_TREE, 3);
    check_ticks(state, MOVING_CHANGES, 3);
}

/* A move to the same position is no change. LeakSanitizer finds the list that was reserved for it, if the full ring has
 * no memory to start at the tick before, which inserts many points. */
static void unchanged_tick_without_memory_can_be_repeated(void **state)
{
    enum { POINTS = 1000 };
    static octree_edit edits[POINTS];
    const place folder = place_in(*state, "film");
    const octreel_recorder_def def = definition(folder.path, MOVING_CHANGES, 2);
    octreel_tick_info about = {.changes = edits};
    octreel_recorder *recorder = open_recorder(&def);
    octreel_status status = octreel_recorder_tick(recorder, NULL, &about);
    assert_int_equal(status, OCTREEL_OK);
    for (; about.change_count < POINTS; about.change_count++)
        edits[about.change_count] = (octree_edit){.kind = OCTREE_EDIT_INSERT, .body.id = 1 + about.change_count};
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_OK);
    edits[0].kind = OCTREE_EDIT_MOVE;
    about.change_count = 1;
    status = OCTREEL_NO_MEMORY;
    for (long count = 0; status != OCTREEL_OK; count++) {
        fail_allocations_after(count);
        status = octreel_recorder_tick(recorder, NULL, &about);
        memory_has_failed();
        assert_true(status == OCTREEL_OK || status == OCTREEL_NO_MEMORY);
    }
    octreel_recorder_destroy(recorder);
}

static void opening_without_memory_returns_no_recorder(void **state)
{
    const place folder = place_in(*state, "film");
    const octreel_recorder_def def = definition(folder.path, MOVING_TREE, 0);
    octreel_recorder *recorder;
    long count = 0;
    for (;; count++) {
        fail_allocations_after(count);
        const octreel_status status = octreel_recorder_open(&def, &recorder, NULL);
        if (!memory_has_failed())
            break;
        assert_int_equal(status, OCTREEL_NO_MEMORY);
        assert_null(recorder);
    }
    assert_true(count > 0);
    octreel_recorder_destroy(recorder);
}

/* ---- The thread that films ------------------------------------------------------------------------------------- */

enum { FILMED = 4 };

static bool has_failed(octreel_status status)
{
    return status != OCTREEL_OK && status != OCTREEL_GAPS;
}

/* One allocation fails in the thread that films; if the recording is incomplete, the recorder must report it. Returns
 * whether an allocation failed. */
static bool film_with_failure(const place *folder, moving_tree_source source, size_t ring, long count)
{
    uint64_t digests[FILMED], told[FILMED];
    octreel_recorder_def def = definition(folder->path, source, ring);
    def.every = 0; /* no frames: allocations of Mesa are not tested */
    octreel_recorder *recorder = open_recorder(&def);
    octreel_status status = OCTREEL_OK;
    moving_tree m;
    moving_edits edits = {.count = 0};
    moving_tree_make(&m, full_leaf_of(source), 11);
    fail_allocations_elsewhere_after(count);
    for (int tick = 0; tick < FILMED && !has_failed(status); tick++, moving_tree_step(&m)) {
        moving_edits_make(&edits, &m);
        digests[tick] = octree_digest(m.tree);
        status = record_tick_from(recorder, &m, source, &edits);
    }
    if (ring && !has_failed(status))
        status = octreel_recorder_write(recorder, folder->path, NULL);
    const octreel_status closed = octreel_recorder_close(recorder);
    const bool met = memory_has_failed_elsewhere();
    if (has_failed(status) || has_failed(closed))
        assert_true(met && *octreel_recorder_error(recorder));
    const bool begun = file_exists(place_below(folder->path, "ticks.jsonl").path);
    const size_t ticks = begun ? tree_digests(folder->path, told, FILMED) : 0;
    assert_memory_equal(told, digests, ticks * sizeof *told);
    if (!has_failed(status) && !has_failed(closed))
        assert_int_equal(ticks, FILMED);
    octreel_recorder_destroy(recorder);
    moving_tree_release(&m);
    return met;
}

static void lack_of_memory_while_recording_is_reported(void **state)
{
    static const struct {
        moving_tree_source source;
        size_t ring;
    } rows[] = {{MOVING_TREE, 0}, {MOVING_CHANGES, 0}, {MOVING_TREE, FILMED}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        bool met = true;
        long count = 0;
        for (; met; count++) {
            char name[40];
            snprintf(name, sizeof name, "film%zu-%ld", i, count);
            const place folder = place_in(*state, name);
            met = film_with_failure(&folder, rows[i].source, rows[i].ring, count);
        }
        assert_true(count >
                    10); /* more if the library is linked statically; in a shared one no allocation fails here */
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(lack_of_memory_while_recording_is_reported), TEST(tick_without_memory_is_a_gap_and_can_be_repeated),
        TEST(ring_without_memory_is_unchanged),           TEST(unchanged_tick_without_memory_can_be_repeated),
        TEST(opening_without_memory_returns_no_recorder),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    fail_one_allocation();
    return failed + cmocka_run_group_tests(tests, NULL, NULL);
}
