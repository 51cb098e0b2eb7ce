/* SPDX-License-Identifier: MIT */
/* test_cli_programs.c - the programs of tests/examples, in Python, JavaScript and awk, are recorded while they print
 * their sessions, and their answers are audited; and the session of boxes. */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"

typedef struct program {
    const char *language, *file;
} program;

static const program python = {"python3", "brute.py"}, javascript = {"node", "brute.js"};

static void need(const program *p)
{
    if (is_program_installed(p->language))
        return;
    print_message("%s is not installed\n", p->language);
    skip();
}

/* Record the output of a program, which gets an argument or "", into "film", and audit the recording. */
static command_result audit_program(void **state, const program *p, const char *argument)
{
    need(p);
    const place folder = place_in(*state, "film");
    const shell_word path = shell_quote(OCTREEL_EXAMPLES);
    return run_script("%1$s %2$s/%3$s %4$s | %5$s record - --size 32x18 --every 10 -o %6$s >%6$s.txt && %5$s audit "
                      "%6$s",
                      p->language, path.text, p->file, argument, octreel_program(), folder.path);
}

static void assert_right(void **state, const program *p)
{
    command_result result = audit_program(state, p, "");
    assert_done(&result);
    assert_non_null(strstr(result.out, "film: 60 answers in 31 ticks, all right\n"));
    command_release(&result);
    result = run_octreel(NULL, "verify %s", place_in(*state, "film").path);
    assert_done(&result);
    command_release(&result);
}

static void assert_fault_found(void **state, const program *p)
{
    command_result result = audit_program(state, p, "stale");
    assert_string_equal(result.err, "");
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "film: 60 answers in 31 ticks, 21 wrong\n"));
    assert_non_null(strstr(result.out, "\nradius: 30 asked, 19 wrong, "));
    assert_non_null(strstr(result.out, "; first wrong at tick 1; "));
    command_release(&result);
}

static void answers_of_a_python_program_are_right(void **state)
{
    assert_right(state, &python);
}

static void stale_index_of_a_python_program_is_found(void **state)
{
    assert_fault_found(state, &python);
}

static void answers_of_a_javascript_program_are_right(void **state)
{
    assert_right(state, &javascript);
}

static void stale_index_of_a_javascript_program_is_found(void **state)
{
    assert_fault_found(state, &javascript);
}

static void both_programs_print_the_same_session(void **state)
{
    const shell_word path = shell_quote(OCTREEL_EXAMPLES);
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    need(&python);
    need(&javascript);
    command_result result =
        run_script("python3 %1$s/brute.py >%2$s && node %1$s/brute.js >%3$s", path.text, a.path, b.path);
    assert_done(&result);
    command_release(&result);
    assert_same_files(a.path, b.path);
}

/* The session of viz/demo: nodes split and merge in nearly all of its 240 ticks. */
static void every_awk_prints_the_same_hunt(void **state)
{
    const shell_word path = shell_quote(OCTREEL_EXAMPLES);
    const place film = place_in(*state, "film");
    command_result result =
        run_script("awk -f %1$s/hunt.awk | %2$s record - --no-frames -o %3$s", path.text, octreel_program(), film.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "moved 113, refused 0, collided 127, full 0, split 238, merged 237\n"));
    command_release(&result);
}

static void boxes_collide_and_overlap_as_in_the_golden_frame(void **state)
{
    const shell_word examples = shell_quote(OCTREEL_EXAMPLES);
    const place film = place_in(*state, "film");
    command_result result = run_script("%1$s record %2$s/boxes.json --size 640x360 -o %3$s && "
                                       "%1$s diff %2$s/../../golden/bodies.ref.png %3$s/frame_000004.png",
                                       octreel_program(), examples.text, film.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "moved 2, refused 0, collided 1, full 0, split 0, merged 0, overlapped 3\n"));
    command_release(&result);
}

static void changed_overlap_of_a_recording_is_found(void **state)
{
    const shell_word examples = shell_quote(OCTREEL_EXAMPLES);
    const place film = place_in(*state, "film");
    command_result result =
        run_script("%1$s record %2$s/boxes.json --size 64x36 -q -o %3$s && "
                   "sed 's/\"pairs\": \\[\\[2, 3/\"pairs\": [[2, 4/' %3$s/ticks.jsonl >%3$s/changed && "
                   "mv %3$s/changed %3$s/ticks.jsonl && %1$s verify %3$s",
                   octreel_program(), examples.text, film.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "pairs[0][1] is 4 in ticks.jsonl, but 3 when the tick is played again"));
    command_release(&result);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(answers_of_a_python_program_are_right),
        IN_FOLDER(stale_index_of_a_python_program_is_found),
        IN_FOLDER(answers_of_a_javascript_program_are_right),
        IN_FOLDER(stale_index_of_a_javascript_program_is_found),
        IN_FOLDER(both_programs_print_the_same_session),
        IN_FOLDER(every_awk_prints_the_same_hunt),
        IN_FOLDER(boxes_collide_and_overlap_as_in_the_golden_frame),
        IN_FOLDER(changed_overlap_of_a_recording_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
