/* SPDX-License-Identifier: MIT */
/* test_recorder_pairs.c - the pairs that a program's index found are recorded with their tick only, and judged. */
#include "fixture.h"

#include <stdio.h>
#include <string.h>

#include "film_again.h"
#include "moving_tree.h"
#include "recordings.h"

/* 10 and 11 are at one position. */
static const octree_point points[] = {{{4, 0, 0}, 10}, {{4, 0, 0}, 11}, {{-4, 0, 0}, 12}};

/* Record a tick. The list and its pairs are overwritten after the call. */
static octreel_status tick(octreel_recorder *recorder, const octree_pair *found, size_t count)
{
    octree_pair pairs[4] = {{0, 0}};
    octree_foreign_pairs list = {.pairs = pairs, .pair_count = count};
    if (found)
        memcpy(pairs, found, count * sizeof *pairs);
    const octreel_tick_info about = {.points = points, .point_count = 3, .foreign_pairs = found ? &list : NULL};
    const octreel_status status = octreel_recorder_tick(recorder, NULL, &about);
    memset(pairs, 0, sizeof pairs);
    return status;
}

static const octree_pair right[] = {{11, 10}}, wrong[] = {{10, 11}, {12, 10}};

/* Append 'W' for a wrong tick, '.' for a right one, '-' for one without pairs. */
static void note_pairs(const char *line, size_t number, void *context)
{
    char *noted = context;
    (void)number;
    strcat(noted, !strstr(line, "\"foreign_pairs\"") ? "-" : strstr(line, "\"extra\": [[10, 12]]") ? "W" : ".");
}

static void pairs_are_recorded_with_their_tick_only(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    assert_int_equal(tick(recorder, right, 1), OCTREEL_OK);
    assert_int_equal(tick(recorder, NULL, 0), OCTREEL_OK);
    assert_int_equal(tick(recorder, wrong, 2), OCTREEL_OK);
    assert_int_equal(tick(recorder, right, 0), OCTREEL_OK);
    close_recorder(recorder);
    assert_noted_lines(folder.path, note_pairs, ".-W.");
    assert_films_again(&folder, &again, 4);
}

static void ring_forgets_pairs_of_earlier_ticks(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(NULL, 2);
    for (int i = 0; i < 3; i++)
        assert_int_equal(tick(recorder, wrong, 2), OCTREEL_OK);
    assert_int_equal(tick(recorder, NULL, 0), OCTREEL_OK);
    assert_int_equal(tick(recorder, right, 1), OCTREEL_OK);
    assert_int_equal(octreel_recorder_write(recorder, folder.path, NULL), OCTREEL_OK);
    close_recorder(recorder);
    assert_noted_lines(folder.path, note_pairs, "-.");
    assert_films_again(&folder, &again, 2);
}

static void assert_refused(octreel_recorder *recorder, octree_pair pair, octreel_status why, const char *sentence)
{
    const octree_pair pairs[] = {right[0], pair};
    assert_int_equal(tick(recorder, pairs, 2), why);
    assert_string_equal(octreel_recorder_error(recorder), sentence);
}

/* The pairs of a refused tick are not kept for the next tick. */
static void invalid_pairs_are_refused_with_their_index(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    assert_refused(recorder, (octree_pair){7, 7}, OCTREEL_BAD_PAIR, "pairs[1]: a foreign pair has one id twice");
    assert_refused(recorder, (octree_pair){7, UINT64_C(1) << 53}, OCTREEL_BAD_ID,
                   "pairs[1]: an id is 2^53 or larger, which session files cannot store");
    const octree_foreign_pairs none = {.pair_count = 1};
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &(octreel_tick_info){.foreign_pairs = &none}),
                     OCTREEL_NULL_ARGUMENT);
    assert_int_equal(tick(recorder, NULL, 0), OCTREEL_OK);
    assert_int_equal(tick(recorder, wrong, 2), OCTREEL_OK);
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_GAPS);
    octreel_recorder_destroy(recorder);
    assert_noted_lines(folder.path, note_pairs, "----W");
    assert_films_again(&folder, &again, 5);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(pairs_are_recorded_with_their_tick_only),
        TEST(ring_forgets_pairs_of_earlier_ticks),
        TEST(invalid_pairs_are_refused_with_their_index),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
