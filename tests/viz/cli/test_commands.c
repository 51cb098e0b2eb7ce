/* SPDX-License-Identifier: MIT */
/* test_commands.c - the functions by which tests run commands: folders with any characters in their names, and programs
 * that end early. */
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "background.h"
#include "commands.h"
#include "files.h"
#include "fixture.h"

static void quoted_words_reach_the_program_unchanged(void **state)
{
    static const char *const texts[] = {"plain", "",    "a (b) 'c' d", "'", "''", "$HOME `x` \\ \" * ~ # & ;",
                                        "-n",    "a\nb"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        command_result result = run_script("printf '<%%s>' %s", shell_quote(texts[i]).text);
        char expected[64];
        snprintf(expected, sizeof expected, "<%s>", texts[i]);
        assert_done(&result);
        assert_string_equal(result.out, expected);
        command_release(&result);
    }
}

static void program_in_a_folder_with_an_odd_name_is_run(void **state)
{
    const place odd = place_in(*state, "a (b) 'c' d");
    const shell_word folder = shell_quote(odd.path), link = shell_quote(place_below(odd.path, "octreel").path);
    command_result result =
        run_script("mkdir %s && ln -s %s %s && %s --help", folder.text, octreel_program(), link.text, link.text);
    assert_done(&result);
    command_release(&result);
}

static void waiting_ends_when_the_program_ends(void **state)
{
    struct timespec started, now;
    const place never = place_in(*state, "never");
    background b = start_octreel("--help");
    clock_gettime(CLOCK_MONOTONIC, &started);
    assert_false(wait_until_file_exists(&b, never.path));
    clock_gettime(CLOCK_MONOTONIC, &now);
    assert_true(now.tv_sec - started.tv_sec < 10); /* waiting for the file would take half a minute */
    command_result result = wait_for_end(&b);
    assert_done(&result);
    command_release(&result);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quoted_words_reach_the_program_unchanged),
        IN_FOLDER(program_in_a_folder_with_an_odd_name_is_run),
        IN_FOLDER(waiting_ends_when_the_program_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
