/* SPDX-License-Identifier: MIT */
/* test_recorder_gaps.c - a refused tick keeps its number: the recording has a gap there with the reason, which closing
 * and verify report. */
#include "fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "film_again.h"
#include "octreel/recorder.h"
#include "recordings.h"

static octreel_recorder *open_small(octree *tree, const char *folder, size_t ring)
{
    octreel_recorder_def def = octreel_recorder_def_default();
    octreel_recorder *recorder;
    octreel_error why;
    def.folder = folder;
    def.tree = octree_definition(tree);
    def.width = 64;
    def.height = 48;
    def.ring = ring;
    if (octreel_recorder_open(&def, &recorder, &why) != OCTREEL_OK)
        fail_msg("%s", why.text);
    return recorder;
}

/* Record a tick for each letter: '.' is accepted; 'i', an id twice, and 'q', a query with NaN, are refused. */
static void record_pattern(octreel_recorder *recorder, octree *tree, const char *pattern)
{
    const octree_query bad = {.kind = OCTREE_QUERY_NEAREST, .target = {NAN}};
    const double twice[] = {1, 1, 1};
    for (uint64_t tick = 0; pattern[tick]; tick++) {
        const bool query = pattern[tick] == 'q', id = pattern[tick] == 'i';
        assert_int_equal(octree_insert(tree, (double[]){(double)tick, 2, 3}, tick), OCTREE_OK);
        if (id)
            assert_int_equal(octree_insert(tree, twice, 0), OCTREE_OK);
        const octreel_tick_info about = {.queries = &bad, .query_count = query};
        assert_int_equal(octreel_recorder_tick(recorder, tree, &about), id      ? OCTREEL_DUPLICATE_ID
                                                                        : query ? OCTREEL_BAD_QUERY
                                                                                : OCTREEL_OK);
        if (id)
            assert_int_equal(octree_remove(tree, twice, 0), OCTREE_OK);
    }
}

static void assert_ends(octreel_recorder *recorder, octreel_status status, octreel_status why, const char *part)
{
    assert_int_equal(status, why);
    if (strstr(octreel_recorder_error(recorder), part) == NULL)
        fail_msg("%s", octreel_recorder_error(recorder));
}

/* The test fails unless the line of a tick fits its letter. */
static void check_line(const char *line, size_t number, void *context)
{
    const char *pattern = context;
    char gap[200];
    snprintf(gap, sizeof gap, "{\"tick\": %zu, \"gap\": \"%s\"}", number,
             pattern[number] == 'i' ? "two points have the same id: 0" : "queries[0]: a number is NaN or infinite");
    if (pattern[number] != '.')
        assert_string_equal(line, gap);
    else
        assert_true(strstr(line, "\"gap\"") == NULL && strstr(line, "\"frame\""));
}

/* Record a pattern. The test fails unless the recording has a line for each tick, and a frame for each accepted tick.
 */
static void check_pattern(void **state, const char *pattern, const char *sentence)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octree *tree = make_tree(cube(-100, 100), 4, 8, OCTREE_GROW);
    octreel_recorder *recorder = open_small(tree, folder.path, 0);
    record_pattern(recorder, tree, pattern);
    assert_ends(recorder, octreel_recorder_close(recorder), OCTREEL_GAPS, sentence);
    octreel_recorder_destroy(recorder);
    octree_destroy(tree);
    assert_int_equal(for_each_line(folder.path, check_line, (void *)pattern), strlen(pattern));
    for (size_t tick = 0; pattern[tick]; tick++)
        assert_int_equal(file_exists(frame_place(folder.path, tick).path), pattern[tick] == '.');
    assert_films_again(&folder, &again, strlen(pattern));
}

static void refused_tick_is_a_gap_and_the_next_tick_keeps_its_number(void **state)
{
    check_pattern(state, "..i.qq.i",
                  "4 of 8 ticks were refused and are gaps in the recording; the first is tick 2: two "
                  "points have the same id: 0");
}

static void gaps_at_the_beginning_are_recorded(void **state)
{
    check_pattern(state, "qi..",
                  "2 of 4 ticks were refused and are gaps in the recording; the first is tick 0: queries");
}

static void gaps_at_the_end_are_recorded(void **state)
{
    check_pattern(state, ".i", "1 of 2 ticks was refused and is a gap in the recording; the first is tick 1: two");
}

static void gaps_with_different_reasons_are_separate(void **state)
{
    check_pattern(state, ".iqiqiqiqiqiqiqiqiqiqiqiqiqiqiqi.", "31 of 33 ticks");
}

static void refused_ticks_alone_make_no_recording(void **state)
{
    const place folder = place_in(*state, "film");
    octree *tree = make_tree(cube(-100, 100), 4, 8, OCTREE_GROW);
    octreel_recorder *recorder = open_small(tree, folder.path, 0);
    record_pattern(recorder, tree, "iq");
    assert_ends(recorder, octreel_recorder_close(recorder), OCTREEL_NOTHING, "two points have the same id: 0");
    octreel_recorder_destroy(recorder);
    octree_destroy(tree);
    assert_false(file_exists(place_below(folder.path, "recording.json").path));
}

/* Tick 0 of the recording must be an accepted tick. */
static void ring_keeps_gaps(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again"), more = place_in(*state, "more");
    uint64_t first;
    octree *tree = make_tree(cube(-100, 100), 4, 8, OCTREE_GROW);
    octreel_recorder *recorder = open_small(tree, NULL, 3);
    record_pattern(recorder, tree, "q..qi..i"); /* the ring keeps ticks 2 to 7 of it */
    assert_ends(recorder, octreel_recorder_write(recorder, folder.path, &first), OCTREEL_GAPS,
                "3 of 6 ticks were refused and are gaps in the recording; the first is tick 1: queries[0]");
    assert_int_equal(first, 2);
    assert_int_equal(for_each_line(folder.path, check_line, (void *)".qi..i"), 6);
    assert_films_again(&folder, &again, 6);
    record_pattern(recorder, tree, "");
    assert_int_equal(octreel_recorder_tick(recorder, tree, NULL), OCTREEL_OK);
    assert_ends(recorder, octreel_recorder_write(recorder, more.path, &first), OCTREEL_GAPS, "1 of 4 ticks was");
    assert_int_equal(first, 5);
    assert_int_equal(for_each_line(more.path, check_line, (void *)"..i."), 4);
    assert_ends(recorder, octreel_recorder_close(recorder), OCTREEL_GAPS, "4 of 9 ticks");
    octreel_recorder_destroy(recorder);
    octree_destroy(tree);
}

static void verify_and_record_report_gaps(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octree *tree = make_tree(cube(-100, 100), 4, 8, OCTREE_GROW);
    octreel_recorder *recorder = open_small(tree, folder.path, 0);
    record_pattern(recorder, tree, "..i.");
    octreel_recorder_destroy(recorder);
    octree_destroy(tree);
    command_result result = run_octreel(NULL, "verify %s", folder.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, ": identical: 4 ticks, 3 frames\n"));
    assert_non_null(strstr(result.out, ": 1 of these ticks is a gap without data; the first is tick 2: two "
                                       "points have the same id: 0\n"));
    command_release(&result);
    result = run_octreel(NULL, "verify --json %s", folder.path);
    assert_non_null(strstr(result.out, "\"gaps\": 1"));
    command_release(&result);
    result = run_octreel(NULL, "record %s/session.json -o %s", folder.path, again.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "1 tick is a gap"));
    command_release(&result);
}

/* A frame at the tick of a gap does not belong to the recording. */
static void frame_in_a_gap_is_found(void **state)
{
    const place folder = place_in(*state, "film"), gap = frame_place(folder.path, 2);
    octree *tree = make_tree(cube(-100, 100), 4, 8, OCTREE_GROW);
    octreel_recorder *recorder = open_small(tree, folder.path, 0);
    record_pattern(recorder, tree, "..i.");
    octreel_recorder_destroy(recorder);
    octree_destroy(tree);
    assert_int_equal(rename(frame_place(folder.path, 3).path, gap.path), 0);
    command_result result = run_octreel(NULL, "verify %s", folder.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "frame_000002.png is not a frame of this recording"));
    command_release(&result);
}

/* The tree chooses its capacity anew when it grows. */
static void change_of_the_capacity_is_named(void **state)
{
    const place folder = place_in(*state, "film");
    octree_def def = octree_def_default();
    octree *tree;
    def.leaf_capacity = OCTREE_AUTO;
    def.full_leaf = OCTREE_GROW;
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    octreel_recorder *recorder = open_small(tree, folder.path, 0);
    assert_int_equal(octreel_recorder_tick(recorder, tree, NULL), OCTREEL_OK);
    octree *other = make_tree(def.world, octree_definition(tree).leaf_capacity + 1, 21, OCTREE_GROW);
    assert_int_equal(octreel_recorder_tick(recorder, other, NULL), OCTREEL_OTHER_TREE);
    assert_ends(recorder, octreel_recorder_close(recorder), OCTREEL_GAPS, "tick 1: the tree's leaf_capacity is");
    octreel_recorder_destroy(recorder);
    octree_destroy(other);
    octree_destroy(tree);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(refused_tick_is_a_gap_and_the_next_tick_keeps_its_number),
        TEST(gaps_at_the_beginning_are_recorded),
        TEST(gaps_at_the_end_are_recorded),
        TEST(gaps_with_different_reasons_are_separate),
        TEST(refused_ticks_alone_make_no_recording),
        TEST(ring_keeps_gaps),
        TEST(verify_and_record_report_gaps),
        TEST(frame_in_a_gap_is_found),
        TEST(change_of_the_capacity_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
