/* SPDX-License-Identifier: MIT */
/* test_cli_quiet.c - every command has --quiet and --version. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "page.h"

#define SMALL "--keys wd --size 32x32 --jobs 1"

/* Run octreel on a terminal, if the system has any, so that progress could be shown. The arguments may contain the
 * folder up to three times. */
static command_result run_quiet(const char *arguments, const char *folder)
{
    const command_setting terminal = {.terminal = command_has_terminals(), .columns = 80};
    return run_octreel(&terminal, arguments, folder, folder, folder);
}

static void assert_silent(command_result result)
{
    assert_int_equal(result.status, 0);
    assert_string_equal(result.out, "");
    assert_string_equal(result.err, "");
    command_release(&result);
}

static void commands_that_write_files_print_nothing(void **state)
{
    const temp_folder *own = *state;
    assert_silent(run_quiet("record " SMALL " --quiet -o %s/film", own->name));
    if (page_can_play())
        assert_silent(run_quiet("play -q -o %s/page.html", own->name));
    assert_silent(run_quiet("record " SMALL " -q --ticks :1 -o %s/chunks", own->name));
    assert_silent(run_octreel(NULL, "record " SMALL " -q --ticks 1: -o %s/chunks", own->name));
    assert_silent(run_quiet("film -q %s/film -o %s/film.png", own->name));
    assert_silent(run_octreel(NULL, "join --quiet %s/chunks", own->name));
    unsetenv("CI"); /* accept refuses to run if CI is set */
    assert_silent(run_octreel(NULL, "accept -q %s/golden %s/film", own->name, own->name));
    assert_int_equal(access(place_in(*state, "golden/frame_000000.png").path, F_OK), 0);
}

/* Most points of the session are refused, which a note would report. */
static void notes_are_omitted_and_errors_are_printed(void **state)
{
    const temp_folder *own = *state;
    file_write_text(place_in(*state, "s.json").path,
                    "{\"octreel\":\"session\",\"version\":2,\"ticks\":1,"
                    "\"world\":{\"min\":[0,0,0],\"max\":[1,1,1]},\"points\":[[9,9,9],[8,8,8],[0,0,0]]}\n");
    command_result result = run_octreel(NULL, "record %s/s.json --size 32x32 -o %s/told", own->name, own->name);
    assert_int_equal(result.status, 0);
    assert_string_not_equal(result.err, "");
    command_release(&result);
    assert_silent(run_octreel(NULL, "record %s/s.json -q --size 32x32 -o %s/film", own->name, own->name));
    result = run_octreel(NULL, "record %s/s.json -q -o %s/film", own->name, own->name);
    assert_trouble(&result, "--replace");
}

static void results_are_printed(void **state)
{
    const temp_folder *own = *state;
    static const char *const asked[][2] = {
        {"record " SMALL " -q --json -o %s/film", "\"ticks\": 3"},
        {"verify -q %s/film", "identical"},
        {"pick -q %s/film/frame_000000.png 1 1", "pixel"},
        {"inspect -q %s/cloud.txt", "points"},
        {"inspect -q %s/cloud.txt --nearest 1,2,3", "found"},
        {"inspect -q %s/cloud.txt --size 32x32 -o %s/tree.png --nodes %s/nodes.csv", "points"},
    };
    file_write_text(place_in(*state, "cloud.txt").path, "1 2 3\n4 5 6\n");
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++) {
        command_result result = run_quiet(asked[i][0], own->name);
        assert_int_equal(result.status, 0);
        assert_string_equal(result.err, "");
        if (!strstr(result.out, asked[i][1]) || strstr(result.out, "wrote"))
            fail_msg("%s: %s", asked[i][0], result.out);
        command_release(&result);
    }
}

static void every_command_prints_the_version(void **state)
{
    (void)state;
    command_result whole = run_octreel(NULL, "--version"), of_command = run_octreel(NULL, "pick --version");
    assert_int_equal(strncmp(whole.out, "octreel ", 8), 0);
    assert_string_equal(of_command.out, whole.out);
    assert_int_equal(of_command.status, whole.status);
    command_release(&whole);
    command_release(&of_command);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(commands_that_write_files_print_nothing),
        IN_FOLDER(notes_are_omitted_and_errors_are_printed),
        IN_FOLDER(results_are_printed),
        cmocka_unit_test(every_command_prints_the_version),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
