/* SPDX-License-Identifier: MIT */
/* test_cli_names.c - empty names are refused, and control characters in names never reach the terminal. */
#include <string.h>

#include <stdio.h>
#include "commands.h"
#include "fixture.h"
#include "galleries.h"

static void empty_names_are_refused_in_one_sentence(void **state)
{
    static const char *const rows[][2] = {
        {"diff '' a.png", "diff: the name is empty"},
        {"diff a.png ''", "diff: the name is empty"},
        {"diff a.png a.png -o ''", "-o: the name is empty"},
        {"diff a.png a.png --junit ''", "--junit: the name is empty"},
        {"diff a.png a.png --markdown=", "--markdown: the name is empty"},
        {"inspect ''", "inspect: the name is empty"},
        {"inspect p.xyz -o ''", "-o: the name is empty"},
        {"inspect p.xyz --nodes ''", "--nodes: the name is empty"},
        {"verify ''", "verify: the name is empty"},
        {"join ''", "join: the name is empty"},
        {"pick '' 1 1", "pick: the name is empty"},
        {"accept '' a.png", "accept: the name is empty"},
        {"record -o ''", "-o: the name is empty"},
    };
    const temp_folder *folder = *state;
    gallery_write(place_in(folder, "a.png").path, 1, 0);
    file_write_text(place_in(folder, "p.xyz").path, "1 2 3\n");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_script("cd %s && env -u CI %s %s", folder->name, octreel_program(), rows[i][0]);
        assert_trouble(&result, rows[i][1]);
        assert_int_equal(temp_folder_count(folder), 2);
    }
}

#define HOSTILE "x\x1b[31m\ny.png"

static void assert_plain(const command_result *result, int status)
{
    assert_int_equal(result->status, status);
    assert_null(strchr(result->out, '\x1b'));
    assert_null(strstr(result->out, "\ny.png"));
    assert_null(strchr(result->err, '\x1b'));
    assert_null(strstr(result->err, "\ny.png"));
}

static void errors_contain_no_control_characters(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), b = gallery_make(*state, "b", "1.png");
    gallery_write(place_below(a.path, HOSTILE).path, 3, 0);
    gallery_write(place_below(b.path, HOSTILE).path, 3, 5);
    command_result result = run_octreel(NULL, "diff %s %s", a.path, b.path);
    assert_plain(&result, 1);
    assert_non_null(strstr(result.out, "y.png: 5 of 384 pixels differ"));
    command_release(&result);
    result = run_octreel(NULL, "diff %s/%s %s", a.path, HOSTILE "none", b.path);
    assert_plain(&result, 2);
    command_release(&result);
    unsetenv("CI");
    result = run_octreel(NULL, "accept %s %s --reason x", place_in(*state, "a.txt").path, a.path);
    assert_trouble(&result, "the frame name \"x?[31m?y.png\" contains a control character");
}

/* Inputs and outputs have a name with control characters. */
static void reports_contain_no_control_characters(void **state)
{
    static const char *const lines[] = {
        "inspect %s --nodes %s.csv",  "inspect %s --node root", "inspect %s --nearest 1,2,3",
        "record -o %s.film --keys w", "verify %s.film",         "pick %s.film/frame_000000.png 1 1",
        "accept %s.film %s.film",
    };
    const place points = place_in(*state, HOSTILE);
    file_write_text(points.path, "1 2 3\n");
    const shell_word name = shell_quote(points.path);
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        char line[512];
        snprintf(line, sizeof line, lines[i], name.text, name.text);
        command_result result = run_script("env -u CI %s %s", octreel_program(), line);
        assert_plain(&result, 0);
        command_release(&result);
    }
}

/* Invalid UTF-8, a mark that reverses the writing direction, and bytes that some terminals read as an escape. */
static void invalid_utf8_is_not_printed(void **state)
{
    static const char *const hostile[] = {"x\xff.png", "x\xe2\x80\xae.png", "x\xc2\x9b.png", "x\xe2\x81\xa7.png"};
    for (size_t i = 0; i < sizeof hostile / sizeof hostile[0]; i++) {
        char bytes[4] = "";
        snprintf(bytes, sizeof bytes, "%.*s", (int)strcspn(hostile[i] + 1, "."), hostile[i] + 1);
        const char *const lines[] = {"diff %s/%s a.png", "verify %s/%s", "inspect %s/%s", "accept %s/%s b"};
        for (size_t j = 0; j < sizeof lines / sizeof lines[0]; j++) {
            const temp_folder *own = *state;
            command_result result =
                run_octreel(&(command_setting){.environment = {"CI="}}, lines[j], own->name, hostile[i]);
            assert_int_equal(result.status, 2);
            assert_null(strstr(result.err, bytes));
            command_release(&result);
        }
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(empty_names_are_refused_in_one_sentence),
        IN_FOLDER(errors_contain_no_control_characters),
        IN_FOLDER(reports_contain_no_control_characters),
        IN_FOLDER(invalid_utf8_is_not_printed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
