/* SPDX-License-Identifier: MIT */
/* test_recorder_answers.c - the answers of a program to its queries are recorded and compared with the exact ones. */
#include "fixture.h"

#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "film_again.h"
#include "moving_tree.h"
#include "recordings.h"

static const octree_point points[] = {{{0, 0, 0}, 10}, {{3, 0, 0}, 11}, {{0, 5, 0}, 12}, {{7, 7, 7}, 13}};

static octreel_recorder *open_small(const char *folder, size_t ring)
{
    octreel_recorder_def def = octreel_recorder_def_default();
    def.folder = folder;
    def.tree.world = cube(-8, 8);
    def.width = 160;
    def.height = 90;
    def.ring = ring;
    return open_recorder(&def);
}

/* Record a query of each kind. The arrays belong to the program again when the call returns. */
static octreel_status ask_all(octreel_recorder *recorder, uint64_t nearest)
{
    uint64_t answers[][3] = {{nearest}, {11, 10}, {10, 11, 12}, {13}};
    octree_query queries[] = {
        {.kind = OCTREE_QUERY_NEAREST, .target = {1, 0, 0}, .answered = true, .answer = answers[0], .answer_count = 1},
        {.kind = OCTREE_QUERY_KNEAREST, .k = 2, .answered = true, .answer = answers[1], .answer_count = 2},
        {.kind = OCTREE_QUERY_RADIUS, .radius = 5, .answered = true, .answer = answers[2], .answer_count = 3},
        {.kind = OCTREE_QUERY_RANGE,
         .box = {{6, 6, 6}, {8, 8, 8}},
         .answered = true,
         .precision = OCTREE_FLOATS,
         .answer = answers[3],
         .answer_count = 1},
        {.kind = OCTREE_QUERY_RANGE, .box = {{1, 1, 1}, {2, 2, 2}}, .answered = true},
        {.kind = OCTREE_QUERY_NEAREST, .target = {1, 0, 0}},
    };
    const octreel_tick_info about = {.queries = queries,
                                     .query_count = sizeof queries / sizeof *queries,
                                     .points = points,
                                     .point_count = sizeof points / sizeof *points};
    const octreel_status status = octreel_recorder_tick(recorder, NULL, &about);
    memset(answers, 0xff, sizeof answers);
    memset(queries, 0xff, sizeof queries);
    return status;
}

static void count_wrong(const char *line, size_t number, void *context)
{
    char *told = context;
    told[number] = strstr(line, "\"wrong\"]") ? 'W' : '.';
}

static void assert_judged(const place *folder, const char *expected)
{
    char told[32] = "";
    assert_int_equal(for_each_line(folder->path, count_wrong, told), strlen(expected));
    assert_string_equal(told, expected);
    command_result result = run_octreel(NULL, "audit %s", folder->path);
    assert_int_equal(result.status, strchr(expected, 'W') ? 1 : 0);
    command_release(&result);
}

static void answers_are_recorded_with_queries_and_judged(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_small(folder.path, 0);
    assert_int_equal(ask_all(recorder, 10), OCTREEL_OK);
    assert_int_equal(ask_all(recorder, 11), OCTREEL_OK);
    assert_int_equal(ask_all(recorder, 99), OCTREEL_OK);
    assert_int_equal(ask_all(recorder, 10), OCTREEL_OK);
    close_recorder(recorder);
    assert_judged(&folder, ".WW.");
    assert_films_again(&folder, &again, 4);
}

static void ring_keeps_answers(void **state)
{
    const place folder = place_in(*state, "film");
    octreel_recorder *recorder = open_small(NULL, 2);
    for (int tick = 0; tick < 5; tick++)
        assert_int_equal(ask_all(recorder, tick == 3 ? 12 : 10), OCTREEL_OK);
    assert_int_equal(octreel_recorder_write(recorder, folder.path, NULL), OCTREEL_OK);
    close_recorder(recorder);
    assert_judged(&folder, "W.");
}

static void answers_that_a_session_file_cannot_hold_are_refused(void **state)
{
    const place folder = place_in(*state, "film");
    octreel_recorder *recorder = open_small(folder.path, 0);
    assert_int_equal(ask_all(recorder, UINT64_C(1) << 53), OCTREEL_BAD_QUERY);
    assert_string_equal(octreel_recorder_error(recorder),
                        "queries[0]: an id is 2^53 or larger, which session files cannot store");
    octree_query query = {.kind = OCTREE_QUERY_NEAREST, .answered = true, .answer_count = 1};
    const octreel_tick_info about = {.queries = &query, .query_count = 1};
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_BAD_QUERY);
    query.answer_count = 0;
    query.precision = OCTREE_PRECISIONS;
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_BAD_QUERY);
    query.precision = OCTREE_DOUBLES;
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_OK);
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_GAPS);
    octreel_recorder_destroy(recorder);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(answers_are_recorded_with_queries_and_judged),
        TEST(ring_keeps_answers),
        TEST(answers_that_a_session_file_cannot_hold_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
