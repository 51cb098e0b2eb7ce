/* SPDX-License-Identifier: MIT */
/* test_cli_audit.c - octreel audit: the verdict on a program's answers; and recordings of sessions that have them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "edits.h"
#include "files.h"
#include "fixture.h"
#include "recordings.h"
#include "tick_lines.h"

/* Point 2 is removed in tick 2. */
#define START                                                                                                          \
    "{\"octreel\":\"session\",\"version\":1,\"player\":null,\"points\":[[1,0,0,1],[2,0,0,2],[0,3,0,3]],\"ticks\":3}\n"
#define FIRST                                                                                                          \
    "{\"tick\":1,\"queries\":[{\"nearest\":[0,0,0],\"answer\":[1]},{\"radius\":3,\"at\":[0,0,0],\"answer\":[3,2,1]}]}" \
    "\n"
#define SECOND(nearest, ball)                                                                                          \
    "{\"tick\":2,\"edits\":[{\"remove\":2}],\"queries\":[{\"nearest\":[2,0,0],\"answer\":" nearest                     \
    "},{\"radius\":3,\"at\":[0,0,0],\"answer\":" ball "}]}\n"

static const char right[] = START FIRST SECOND("[1]", "[1,3]");
static const char wrong[] = START FIRST SECOND("[3]", "[1,2]");

static place write_session_text(void **state, const char *text)
{
    const place session = place_in(*state, "session.json");
    file_write_text(session.path, text);
    return session;
}

static void right_answers_end_with_0(void **state)
{
    const place session = write_session_text(state, right);
    command_result result = run_octreel(NULL, "audit %s", session.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, ": 4 answers in 4 ticks, all right\n"
                                       "nearest: 2 asked, 0 wrong, recall 1, ratio of distances 1 at worst, 99th "
                                       "percentile 1\n"
                                       "radius: 2 asked, 0 wrong, recall 1, 0 missed, 0 extra\n"));
    command_release(&result);
}

static void wrong_answers_are_told_with_their_numbers_and_end_with_1(void **state)
{
    const place session = write_session_text(state, wrong);
    command_result result = run_octreel(NULL, "audit %s", session.path);
    assert_int_equal(result.status, 1);
    assert_string_equal(result.err, "");
    assert_non_null(strstr(result.out, ": 4 answers in 4 ticks, 2 wrong\n"));
    assert_non_null(strstr(result.out,
                           "nearest: 2 asked, 1 wrong, recall 0.5, ratio of distances 3.60555 at worst, 99th "
                           "percentile 3.60555; first wrong at tick 2\n"));
    assert_non_null(strstr(result.out,
                           "  tick 2, answers[0]: a neighbour too far away; wrong from rank 1 on; ratio of "
                           "distances 3.60555; 1 missed, 1 extra\n    {\"nearest\": {\"target\": [2, 0, 0]"));
    assert_non_null(strstr(result.out,
                           "radius: 2 asked, 1 wrong, recall 0.8, 1 missed, 0 extra; first wrong at tick 2\n"
                           "  tick 2, answers[1]: names an id that no point has (2); 1 missed, 0 extra\n"));
    command_release(&result);
}

static void json_is_one_object(void **state)
{
    const place session = write_session_text(state, wrong);
    command_result result = run_octreel(NULL, "audit %s --json", session.path);
    assert_int_equal(result.status, 1);
    json_t *all = json_read(result.out), *kinds = json_object_get(all, "kinds");
    const json_t *nearest = json_object_get(kinds, "nearest"), *radius = json_object_get(kinds, "radius");
    assert_true(json_is_false(json_object_get(all, "right")) && json_object_size(kinds) == 2);
    assert_true(json_number_value(json_object_get(nearest, "first_wrong_tick")) == 2);
    const json_t *worst = json_array_get(json_object_get(radius, "worst"), 0);
    assert_string_equal(json_string_value(json_object_get(worst, "wrong")), "unknown");
    assert_non_null(json_object_get(json_object_get(json_object_get(worst, "answer"), "radius"), "judged"));
    json_decref(all);
    command_release(&result);
}

static void sessions_without_answers_are_trouble(void **state)
{
    const place session = write_session_text(state, START "{\"tick\":1,\"queries\":[{\"nearest\":[0,0,0]}]}");
    command_result result = run_octreel(NULL, "audit %s", session.path);
    assert_trouble(&result, "session.json: no query has an \"answer\"");
    result = run_octreel(NULL, "audit %s.none", session.path);
    assert_trouble(&result, "there is no such file");
}

/* A recording keeps the answers, has the judgement in its ticks, verifies, and is audited as its session is. */
static void recordings_keep_answers_and_judgements(void **state)
{
    const place session = write_session_text(state, wrong), folder = place_in(*state, "film");
    command_result result = run_octreel(NULL, "record %s --size 64x48 -o %s", session.path, folder.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, ", wrong 1\n"));
    command_release(&result);
    char *ticks = file_read(place_in(*state, "film/ticks.jsonl").path, NULL);
    assert_non_null(strstr(ticks, "\"events\": [\"wrong\"]"));
    assert_non_null(strstr(ticks,
                           "\"judged\": {\"answer\": [3], \"wrong\": \"farther\", \"expected\": 1, \"missed\": [1], "
                           "\"extra\": [3], \"rank\": 1, \"ratio\": 3.605551275463989}"));
    assert_non_null(strstr(ticks,
                           "\"judged\": {\"answer\": [1, 2], \"wrong\": \"unknown\", \"wrong_id\": 2, \"expected\": 2, "
                           "\"missed\": [3]}"));
    assert_non_null(strstr(ticks, "\"judged\": {\"answer\": [3, 2, 1], \"wrong\": \"none\", \"expected\": 3}"));
    free(ticks);
    result = run_octreel(NULL, "verify %s", folder.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "audit %s", folder.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "2 wrong"));
    command_release(&result);
}

/* A program that is mended: only its answers change, and with them the judgements. */
static void diff_names_the_answers_that_became_wrong(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    const char *const texts[] = {START FIRST SECOND("[1]", "[1,3]"), START FIRST SECOND("[3]", "[1,3]")};
    for (int i = 0; i < 2; i++) {
        const place session = write_session_text(state, texts[i]);
        command_result result = run_octreel(NULL, "record %s --size 64x48 -o %s", session.path, i ? b.path : a.path);
        assert_done(&result);
        command_release(&result);
    }
    command_result result = run_octreel(NULL, "diff %s %s", a.path, b.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "another answer of the program in the nearest query ((3), was (1))"));
    assert_non_null(
        strstr(result.out, "another judgement of the program's answer in the nearest query (farther, was none)"));
    command_release(&result);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(right_answers_end_with_0),
        IN_FOLDER(wrong_answers_are_told_with_their_numbers_and_end_with_1),
        IN_FOLDER(json_is_one_object),
        IN_FOLDER(sessions_without_answers_are_trouble),
        IN_FOLDER(recordings_keep_answers_and_judgements),
        IN_FOLDER(diff_names_the_answers_that_became_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
