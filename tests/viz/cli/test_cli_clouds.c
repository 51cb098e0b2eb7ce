/* SPDX-License-Identifier: MIT */
/* test_cli_clouds.c - octreel inspect refuses bad clouds and output paths, names the classes of points, and shows
 * progress. */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"

static place write_cloud(void **state, const char *name, size_t count)
{
    const place file = place_in(*state, name);
    FILE *out = fopen(file.path, "wb");
    assert_non_null(out);
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%zu %zu %zu\n", i % 11, i % 7, i);
    assert_int_equal(fclose(out), 0);
    return file;
}

static void bad_clouds_are_refused_with_file_and_reason(void **state)
{
    static const char *const rows[][2] = {
        {"", "cloud: "},
        {"# nothing\n\n", "cloud: "},
        {"1 2\n", "cloud:1: "},
        {"1 2 3\n4 5\n", "cloud:2: "},
        {"1 2 3\n4 five 6\n", "cloud:2: "},
        {"1 2 3\n4 1e999 6\n", "cloud:2: "},
        {"nan 5 6\n", "cloud: "},
        {"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
         "1 2 3\n",
         "cloud"},
        {"VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 9999999999\nHEIGHT 9999999999\n"
         "POINTS 99999999999999999\nDATA ascii\n1 2 3\n",
         "cloud"},
    };
    const place points = place_in(*state, "cloud"), picture = place_in(*state, "tree.png");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        file_write_text(points.path, rows[i][0]);
        command_result result = run_octreel(NULL, "inspect %s -o %s", points.path, picture.path);
        assert_trouble(&result, rows[i][1]);
        assert_false(file_exists(picture.path));
    }
}

static void missing_clouds_and_bad_output_paths_are_refused_in_one_sentence(void **state)
{
    const temp_folder *own = *state;
    const place points = place_in(own, "points.txt"), absent = place_in(own, "absent");
    file_write_text(points.path, "1 2 3\n");
    command_result result = run_octreel(NULL, "inspect %s", absent.path);
    assert_trouble(&result, absent.path);
    result = run_octreel(NULL, "inspect %s", own->name);
    assert_trouble(&result, own->name);
    result = run_octreel(NULL, "inspect %s -o %s/tree.png", points.path, absent.path);
    assert_trouble(&result, absent.path);
    result = run_octreel(NULL, "inspect %s --nodes %s", points.path, own->name);
    assert_trouble(&result, own->name);
    result = run_octreel(NULL, "inspect %s -o %s", points.path, own->name);
    assert_trouble(&result, own->name);
    result = run_octreel(NULL, "inspect %s --nodes %s/nodes.csv", points.path, absent.path);
    assert_trouble(&result, absent.path);
    assert_int_equal(temp_folder_count(own), 1);
}

/* If there are many classes, the lowest are named and the others counted. */
static void statistics_list_classes_if_they_are_few(void **state)
{
    static const struct {
        int classes;
        const char *words;
    } rows[] = {{1, "  values    class 0\n"},
                {2, "  values    classes 0, 1\n"},
                {16, "classes 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15\n"},
                {19, ", 13, 14, 15 and 3 more\n"}};
    const place points = place_in(*state, "points.xyz");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        FILE *out = fopen(points.path, "wb");
        assert_non_null(out);
        fputs("x y z class\n", out);
        for (int n = 0; n < 20; n++)
            fprintf(out, "%d 1 2 %d\n", n, n % rows[i].classes);
        assert_int_equal(fclose(out), 0);
        command_result result = run_octreel(NULL, "inspect %s", points.path);
        assert_done(&result);
        if (!strstr(result.out, rows[i].words))
            fail_msg("%s", result.out);
        command_release(&result);
    }
}

/* Replaces the number of bytes by x: it depends on which task of the build takes free memory first. */
static void mask_memory(char *report)
{
    char *line = strstr(report, "\n  memory ");
    assert_non_null(line);
    for (char *c = line + 1; *c != '\n'; c++)
        if (*c >= '0' && *c <= '9')
            *c = '0';
}

static void progress_is_shown_only_on_a_terminal(void **state)
{
    static const command_setting terminal = {.terminal = true};
    const place a = write_cloud(state, "a.txt", 140000);
    command_result quiet = run_octreel(NULL, "inspect %s", a.path);
    assert_done(&quiet);
    if (!command_has_terminals()) {
        print_message("this container has no /dev/pts: progress on a terminal is not tested\n");
        command_release(&quiet);
        skip();
    }
    command_result shown = run_octreel(&terminal, "inspect %s", a.path);
    assert_int_equal(shown.status, 0);
    assert_non_null(strstr(shown.err, " kB read"));
    assert_non_null(strstr(shown.err, "] 140000/140000 points inserted"));
    assert_null(strchr(shown.err, '\n'));
    assert_string_equal(shown.err + strlen(shown.err) - 2, " \r");
    assert_null(strchr(shown.err, '\033'));
    mask_memory(shown.out);
    mask_memory(quiet.out);
    assert_string_equal(shown.out, quiet.out);
    command_release(&quiet);
    command_release(&shown);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(bad_clouds_are_refused_with_file_and_reason),
        IN_FOLDER(missing_clouds_and_bad_output_paths_are_refused_in_one_sentence),
        IN_FOLDER(statistics_list_classes_if_they_are_few),
        IN_FOLDER(progress_is_shown_only_on_a_terminal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
