/* SPDX-License-Identifier: MIT */
/* test_cli_no_frames.c - recordings without frames are verified, compared and accepted by their ticks. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands.h"
#include "edits.h"
#include "fixture.h"
#include "recordings.h"

/* "a" and "same" are recordings of one session, the session of "b" differs from tick 3 on, and "film" has frames. */
static int make_recordings(void **state)
{
    static const char *const rows[][2] = {
        {"a", "--no-frames --keys=wwd"},
        {"same", "--no-frames --keys=wwd"},
        {"b", "--no-frames --keys=wwe"},
        {"film", "--size 160x90 --keys=wwd"},
    };
    if (temp_folder_make(state) != 0)
        return -1;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_octreel(NULL, "record %s -o %s", rows[i][1], place_in(*state, rows[i][0]).path);
        assert_done(&result);
        command_release(&result);
    }
    return 0;
}

static command_result run_in(const temp_folder *folder, const char *arguments)
{
    return run_script("cd %s && env -u CI %s %s", folder->name, octreel_program(), arguments);
}

static void assert_says(const temp_folder *folder, const char *arguments, int status, const char *part)
{
    command_result result = run_in(folder, arguments);
    if (result.status != status || !strstr(result.out, part))
        fail_msg("octreel %s: %d, \"%s\" (%s) and not \"%s\"", arguments, result.status, result.out, result.err, part);
    assert_string_equal(result.err, "");
    command_release(&result);
}

static void verify_says_that_it_compared_ticks(void **state)
{
    assert_says(*state, "verify a", 0,
                "a: identical: 4 ticks, compared by ticks.jsonl alone, since there are no frames\n");
    assert_says(*state, "verify a --json", 0, "\"drawn_by\": null, \"drawn_now\": null, \"fill\": null}\n");
}

static void diff_compares_ticks_of_recordings_without_frames(void **state)
{
    assert_says(*state, "diff a same", 0,
                "same: compared by ticks, because neither recording has frames\ncompared exactly\n");
    assert_says(*state, "diff a b", 1,
                "different: compared by ticks, because neither recording has frames\nanother key");
    assert_says(*state, "diff a b --json", 1, "\"verdict\": \"different\", \"headline\": \"another key");
    assert_says(*state, "diff a b --markdown -", 1,
                "### octreel diff: different: compared by ticks, because neither recording has frames\n");
    assert_says(*state, "diff a b -o evidence", 1, "evidence: evidence/report.html\n");
}

static void annotations_name_the_different_ticks(void **state)
{
    command_result result = run_in(*state, "diff a b --annotate");
    assert_int_equal(result.status, 1);
    assert_memory_equal(result.err, "::error title=octreel diff%3A the ticks differ::another key ", 60);
    assert_ptr_equal(strchr(result.err, '\n'), result.err + strlen(result.err) - 1);
    command_release(&result);
    result = run_in(*state, "diff a b --annotate --causes 0");
    assert_string_equal(result.err, "::error title=octreel diff%3A the ticks differ::ticks.jsonl differs\n");
    command_release(&result);
    assert_says(*state, "diff a same --annotate", 0, "same: compared by ticks");
}

static void edited_tick_is_a_difference(void **state)
{
    edit_file(place_in(*state, "same").path, "ticks.jsonl", "\"key\": \"d\"", "\"key\": \"a\"");
    assert_says(*state, "diff a same", 1, "same/ticks.jsonl at tick 3 differs from what its session gives");
}

static void junit_has_a_case_for_the_ticks(void **state)
{
    assert_says(*state, "diff a same --junit -", 0,
                "tests=\"1\" failures=\"0\" errors=\"0\" skipped=\"0\" time=\"0\">\n"
                "    <testcase classname=\"same\" name=\"ticks.jsonl\" time=\"0\"/>\n");
    assert_says(*state, "diff a b --junit -", 1,
                "tests=\"1\" failures=\"1\" errors=\"0\" skipped=\"0\" time=\"0\">\n"
                "    <testcase classname=\"b\" name=\"ticks.jsonl\" time=\"0\">\n"
                "      <failure type=\"ticks\" message=\"different: another key");
}

static void recordings_with_and_without_frames_are_not_compared(void **state)
{
    static const char *const rows[][2] = {
        {"diff a film", "a is a recording without frames, but film is not"},
        {"diff film a", "a is a recording without frames, but film is not"},
        {"diff a film/frame_000000.png", "a is a recording without frames, but film/frame_000000.png is not"},
        {"accept film a", "a is a recording without frames, but film is not"},
        {"accept a film", "a is a recording without frames, but film is not"},
        {"accept a b frame_000000.png", "no frame frame_000000.png"},
        {"diff a .", "a is a recording without frames, but . is not"},
        {"accept new.txt a --reason x", "a is a recording without frames, but new.txt is not"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_in(*state, rows[i][0]);
        assert_trouble(&result, rows[i][1]);
    }
}

static void accept_copies_the_ticks(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b"), new = place_in(*state, "new");
    assert_says(*state, "accept a same", 0, "a: the ticks are unchanged\n");
    assert_says(*state, "accept a same --json", 0, "{\"reference\": \"a\", \"ticks\": \"same\"}\n");
    assert_says(*state, "accept a b", 0, "a: the ticks are new\n");
    assert_same_folders(a.path, b.path, NULL);
    assert_says(*state, "accept new b --json", 0, "{\"reference\": \"new\", \"ticks\": \"new\"}\n");
    assert_same_folders(new.path, b.path, NULL);
}

#define OF_RECORDINGS(test) cmocka_unit_test_setup_teardown(test, make_recordings, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        OF_RECORDINGS(verify_says_that_it_compared_ticks),
        OF_RECORDINGS(diff_compares_ticks_of_recordings_without_frames),
        OF_RECORDINGS(annotations_name_the_different_ticks),
        OF_RECORDINGS(edited_tick_is_a_difference),
        OF_RECORDINGS(junit_has_a_case_for_the_ticks),
        OF_RECORDINGS(recordings_with_and_without_frames_are_not_compared),
        OF_RECORDINGS(accept_copies_the_ticks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
