/* test_cli_clouds.c - octreel inspect of several clouds: each as if alone, in a folder for their pictures, and how far
 * it is. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "tick_lines.h"

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

/* A command on one cloud: what it prints, and the files it makes of it. */
static char *output_of(const char *format, const char *cloud, const char *picture, const char *nodes)
{
    command_result result = run_octreel(NULL, format, cloud, picture, nodes);
    assert_done(&result);
    char *text = strdup(result.out);
    assert_non_null(text);
    command_release(&result);
    return text;
}

static void assert_same_file(const char *a, const char *b)
{
    size_t sizes[2];
    char *bytes[] = {file_read(a, &sizes[0]), file_read(b, &sizes[1])};
    assert_int_equal(sizes[0], sizes[1]);
    assert_memory_equal(bytes[0], bytes[1], sizes[0]);
    free(bytes[0]);
    free(bytes[1]);
}

static void each_of_several_clouds_is_as_if_alone(void **state)
{
    static const char *const modes[] = {"", "--json", "--node root", "--nearest 1,2,3 --json"};
    const place a = write_cloud(state, "a.txt", 500), b = write_cloud(state, "b.xyz", 90);
    const place one = place_in(*state, "one.png"), csv = place_in(*state, "one.csv");
    const place folder = place_in(*state, "made/pictures"), nodes = place_in(*state, "nodes/");
    for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++) {
        char alone[128], whole[4096];
        snprintf(alone, sizeof alone, "inspect %%s -o %%s --nodes %%s --size 160x90 %s", modes[i]);
        command_result result = run_octreel(NULL, "inspect %s %s -o %s --nodes %s --size 160x90 %s", a.path, b.path,
                                            folder.path, nodes.path, modes[i]);
        assert_done(&result);
        char *first = output_of(alone, a.path, one.path, csv.path);
        assert_same_file(one.path, place_below(folder.path, "a.txt.png").path);
        assert_same_file(csv.path, place_below(nodes.path, "a.txt.csv").path);
        char *second = output_of(alone, b.path, one.path, csv.path);
        assert_same_file(one.path, place_below(folder.path, "b.xyz.png").path);
        assert_same_file(csv.path, place_below(nodes.path, "b.xyz.csv").path);
        snprintf(whole, sizeof whole, "%s%s", first, second);
        assert_string_equal(result.out, whole);
        free(first);
        free(second);
        command_release(&result);
    }
}

/* A folder that is there, or that ends in a slash, takes the picture of one cloud too. */
static void one_cloud_has_its_picture_in_a_folder_that_is_named(void **state)
{
    const place a = write_cloud(state, "a.txt", 50), there = place_in(*state, "there"), made = place_in(*state, "made");
    assert_int_equal(mkdir(there.path, 0777), 0);
    command_result result = run_octreel(NULL, "inspect %s --size 64x64 -o %s", a.path, there.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "inspect %s --size 64x64 -o %s/", a.path, made.path);
    assert_done(&result);
    command_release(&result);
    assert_same_file(place_below(there.path, "a.txt.png").path, place_below(made.path, "a.txt.png").path);
}

static void one_that_cannot_be_read_does_not_keep_the_others(void **state)
{
    const place a = write_cloud(state, "a.txt", 50), b = write_cloud(state, "b.txt", 60);
    const place bad = place_in(*state, "bad.txt"), folder = place_in(*state, "pictures");
    file_write_text(bad.path, "1 2\n");
    command_result result =
        run_octreel(NULL, "inspect %s %s %s --size 64x64 -o %s --json", a.path, bad.path, b.path, folder.path);
    assert_int_equal(result.status, 2);
    assert_non_null(strstr(result.err, "bad.txt:1: "));
    assert_ptr_equal(strchr(result.err, '\n'), result.err + strlen(result.err) - 1);
    assert_non_null(strstr(result.out, "\"a.txt\""));
    assert_non_null(strstr(result.out, "\"b.txt\""));
    assert_null(strstr(result.out, "bad"));
    assert_true(file_exists(place_below(folder.path, "a.txt.png").path));
    assert_true(file_exists(place_below(folder.path, "b.txt.png").path));
    assert_false(file_exists(place_below(folder.path, "bad.txt.png").path));
    command_release(&result);
}

static void places_for_several_pictures_that_are_none_are_refused(void **state)
{
    const place a = write_cloud(state, "a.txt", 5), b = write_cloud(state, "b.txt", 5);
    const place sub = place_in(*state, "sub"), twin = place_in(*state, "sub/a.txt"), file = place_in(*state, "file");
    assert_int_equal(mkdir(sub.path, 0777), 0);
    file_write_text(twin.path, "1 2 3\n");
    file_write_text(file.path, "mine");
    command_result result = run_octreel(NULL, "inspect %s %s -o tree.png", a.path, b.path);
    assert_trouble(&result, "-o tree.png is one file; for several clouds it takes a folder");
    result = run_octreel(NULL, "inspect %s %s --nodes nodes.csv", a.path, b.path);
    assert_trouble(&result, "--nodes nodes.csv is one file");
    result = run_octreel(NULL, "inspect %s %s -o %s", a.path, b.path, file.path);
    assert_trouble(&result, "is one file");
    result = run_octreel(NULL, "inspect %s %s -o %s", a.path, twin.path, sub.path);
    assert_trouble(&result, "would be the same file");
    result = run_octreel(NULL, "inspect %s %s -o %s/in", a.path, b.path, file.path);
    assert_int_equal(result.status, 2);
    assert_string_equal(result.out, "");
    command_release(&result);
}

static void progress_is_shown_on_a_terminal_alone(void **state)
{
    static const command_setting terminal = {.terminal = true};
    const place a = write_cloud(state, "a.txt", 140000), b = write_cloud(state, "b.txt", 70000);
    command_result quiet = run_octreel(NULL, "inspect %s %s", a.path, b.path);
    assert_done(&quiet);
    if (!command_has_terminals()) {
        print_message("a container without /dev/pts: there is no terminal to show progress on\n");
        command_release(&quiet);
        skip();
    }
    command_result shown = run_octreel(&terminal, "inspect %s %s", a.path, b.path);
    assert_int_equal(shown.status, 0);
    assert_non_null(strstr(shown.err, " kB of clouds"));
    assert_non_null(strstr(shown.err, "] building the tree of 140000 points"));
    assert_non_null(strstr(shown.err, "] building the tree of 70000 points"));
    assert_null(strchr(shown.err, '\n'));
    assert_string_equal(shown.err + strlen(shown.err) - 4, "\r\033[K");
    assert_string_equal(shown.out, quiet.out);
    command_release(&quiet);
    command_release(&shown);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(each_of_several_clouds_is_as_if_alone),
        IN_FOLDER(one_cloud_has_its_picture_in_a_folder_that_is_named),
        IN_FOLDER(one_that_cannot_be_read_does_not_keep_the_others),
        IN_FOLDER(places_for_several_pictures_that_are_none_are_refused),
        IN_FOLDER(progress_is_shown_on_a_terminal_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
