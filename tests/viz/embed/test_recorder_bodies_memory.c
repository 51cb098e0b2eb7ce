/* SPDX-License-Identifier: MIT */
/* test_recorder_bodies_memory.c - if the n-th allocation of a tick with bodies fails, for n = 0, 1, 2 ..., the tick is
 * a gap and can be repeated, and no extents are lost. Then the same for the thread that films. */
#include "fixture.h"

#include <stdio.h>

#include "failing_memory.h"
#include "files.h"
#include "moving_bodies.h"
#include "moving_tree.h"

enum { BEFORE = 3, TICKS = 6 };

/* Even and odd ticks have these sources. Allocations fail in an odd tick. */
typedef struct source_pair {
    bodies_source sources[2];
    size_t ring;
} source_pair;

static const source_pair rows[] = {{{BODIES_CHANGES, BODIES_CHANGES}, 0},
                                   {{BODIES_LIST, BODIES_CHANGES}, 0},
                                   {{BODIES_CHANGES, BODIES_LIST}, 0},
                                   {{BODIES_SET, BODIES_SET}, 0},
                                   {{BODIES_LIST, BODIES_CHANGES}, BEFORE}};

static place numbered_place(void **state, size_t row, long count)
{
    char name[40];
    snprintf(name, sizeof name, "film%zu-%ld", row, count);
    return place_in(*state, name);
}

/* Record, and let the call of tick BEFORE succeed in no more than `count` allocations. A refused call is repeated.
 * Returns whether an allocation failed. */
static bool record_with_failure(moving_bodies *m, octreel_recorder *recorder, const source_pair *row, long count)
{
    bool failed = false;
    for (int tick = 0; tick < TICKS; tick++) {
        const bodies_source source = row->sources[tick % 2];
        if (row->ring && tick == TICKS - BEFORE)
            moving_bodies_forget_ticks(m);
        if (tick == BEFORE)
            fail_allocations_after(count);
        octreel_status status = moving_bodies_record(m, recorder, source);
        failed |= tick == BEFORE && memory_has_failed();
        if (status == OCTREEL_NO_MEMORY && failed) {
            if (m->ticks > 0)
                moving_bodies_expect_gap(m, "out of memory");
            status = moving_bodies_record(m, recorder, source);
        }
        assert_int_equal(status, OCTREEL_OK);
        moving_bodies_step(m);
    }
    return failed;
}

static void tick_without_memory_is_a_gap_and_can_be_repeated(void **state)
{
    static moving_bodies m;
    for (size_t row = 0; row < sizeof rows / sizeof *rows; row++) {
        bool failed = true;
        long count = 0;
        for (; failed; count++) {
            const place folder = numbered_place(state, row, count);
            octreel_recorder *recorder =
                open_recorder_without_frames(rows[row].ring ? NULL : folder.path, rows[row].ring);
            moving_bodies_make(&m, 3);
            failed = record_with_failure(&m, recorder, &rows[row], count);
            if (rows[row].ring)
                assert_int_equal(octreel_recorder_write(recorder, folder.path, NULL), OCTREEL_OK);
            octreel_recorder_destroy(recorder);
            moving_bodies_assert_recorded(&m, folder.path);
            moving_bodies_release(&m);
        }
        assert_true(count > 3);
    }
}

/* ---- The thread that films ----------------------------------------------------------------------------------- */

static bool has_failed(octreel_status status)
{
    return status != OCTREEL_OK && status != OCTREEL_GAPS;
}

/* One allocation fails in the thread that films. If the recording is incomplete, the recorder must report it. Returns
 * whether an allocation failed. */
static bool film_with_failure(const place *folder, const source_pair *row, long count)
{
    static moving_bodies m;
    octreel_recorder *recorder = open_recorder_without_frames(row->ring ? NULL : folder->path, row->ring);
    octreel_status status = OCTREEL_OK;
    moving_bodies_make(&m, 5);
    fail_allocations_elsewhere_after(count);
    for (int tick = 0; tick < BEFORE && !has_failed(status); tick++, moving_bodies_step(&m))
        status = moving_bodies_record(&m, recorder, row->sources[tick % 2]);
    if (row->ring && !has_failed(status))
        status = octreel_recorder_write(recorder, folder->path, NULL);
    const octreel_status closed = octreel_recorder_close(recorder);
    const bool met = memory_has_failed_elsewhere();
    if (has_failed(status) || has_failed(closed))
        assert_true(met && *octreel_recorder_error(recorder));
    else
        moving_bodies_assert_recorded(&m, folder->path);
    octreel_recorder_destroy(recorder);
    moving_bodies_release(&m);
    return met;
}

static void lack_of_memory_while_recording_is_reported(void **state)
{
    static const size_t tested[] = {0, 4};
    for (size_t i = 0; i < sizeof tested / sizeof *tested; i++) {
        bool met = true;
        long count = 0;
        for (; met; count++) {
            const place folder = numbered_place(state, 10 + i, count);
            met = film_with_failure(&folder, &rows[tested[i]], count);
        }
        assert_true(count > 10);
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(tick_without_memory_is_a_gap_and_can_be_repeated),
        TEST(lack_of_memory_while_recording_is_reported),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    fail_one_allocation();
    return failed + cmocka_run_group_tests(tests, NULL, NULL);
}
