/* SPDX-License-Identifier: MIT */
/* test_cli_outputs.c - octreel never overwrites an input or another output, whatever their paths look like; a refused
 * command writes nothing; left-out elements are reported. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "fixture.h"
#include "galleries.h"

static const char points[] = "0 0 0\n1 2 3\n4 5 6\n";

/* Run octreel in the folder of the test. */
static command_result run_in(void **state, const char *arguments)
{
    const temp_folder *own = *state;
    return run_script("cd %s && %s %s", own->name, octreel_program(), arguments);
}

static void do_in(void **state, const char *arguments)
{
    command_result result = run_in(state, arguments);
    assert_done(&result);
    command_release(&result);
}

static void assert_refused(void **state, const char *arguments, const char *sentence)
{
    const temp_folder *own = *state;
    const int count = (int)temp_folder_count(own);
    command_result result = run_in(state, arguments);
    assert_trouble(&result, sentence);
    assert_int_equal(temp_folder_count(own), count);
}

static void assert_text(void **state, const char *name, const char *expected)
{
    char *text = file_read(place_in(*state, name).path, NULL);
    assert_string_equal(text, expected);
    free(text);
}

static void assert_has_text(void **state, const char *name, const char *part, bool there)
{
    char *text = file_read(place_in(*state, name).path, NULL);
    if ((strstr(text, part) != NULL) != there)
        fail_msg("\"%s\" %s \"%s\"", text, there ? "does not say" : "says", part);
    free(text);
}

static void cloud_is_not_overwritten(void **state)
{
    file_write_text(place_in(*state, "p").path, points);
    assert_int_equal(link(place_in(*state, "p").path, place_in(*state, "linked").path), 0);
    assert_refused(state, "inspect p -o p", "-o p is the same file as p, which is read");
    assert_refused(state, "inspect p -o ./p", "-o ./p is the same file as p, which is read");
    assert_refused(state, "inspect p --nodes p", "--nodes p is the same file as p");
    assert_refused(state, "inspect p --nodes linked", "--nodes linked is the same file as p");
    assert_text(state, "p", points);
}

static void two_outputs_of_inspect_must_be_different_files(void **state)
{
    file_write_text(place_in(*state, "p.xyz").path, points);
    assert_refused(state, "inspect p.xyz -o n --nodes n", "--nodes n is the same file as -o n");
    assert_refused(state, "inspect p.xyz -o ./n --nodes n", "--nodes n is the same file as -o ./n");
    file_write_text(place_in(*state, "n").path, "");
    assert_refused(state, "inspect p.xyz -o ./n --nodes n", "--nodes n is the same file as -o ./n");
}

/* A link to a frame, whose name does not look like a picture. */
static void link_both(void **state)
{
    static const char *const folders[] = {"a", "b"};
    for (size_t i = 0; i < 2; i++) {
        const place folder = place_in(*state, folders[i]);
        assert_int_equal(link(place_below(folder.path, "2.png").path, place_below(folder.path, "two").path), 0);
    }
}

static void recording_files_are_not_overwritten(void **state)
{
    do_in(state, "record --size 16x16 --keys w -o r");
    assert_refused(state, "diff r r --markdown r/ticks.jsonl", "is the same file as r/ticks.jsonl, which is read");
    assert_refused(state, "diff r r --junit r/session.json", "is the same file as r/session.json, which is read");
}

static void reports_overwrite_no_compared_file(void **state)
{
    gallery_make(*state, "a", "1.png 2.png");
    gallery_make(*state, "b", "1.png 2.png");
    link_both(state);
    do_in(state, "accept a.dig a --reason x");
    char *before = file_read(place_in(*state, "a.dig").path, NULL);
    assert_refused(state, "diff a.dig b --junit a.dig", "--junit a.dig is the same file as a.dig, which is read");
    assert_refused(state, "diff a/1.png b/2.png --markdown b/two", "--markdown b/two is the same file as b/2.png");
    assert_refused(state, "diff a b --junit b/two", "--junit b/two is the same file as b/2.png, which is read");
    assert_text(state, "a.dig", before);
    assert_same_folders(place_in(*state, "a").path, place_in(*state, "b").path, NULL);
    free(before);
}

static void two_reports_must_be_different_files(void **state)
{
    gallery_make(*state, "a", "1.png 2.png");
    assert_refused(state, "diff a a --junit x --markdown x", "--markdown x is the same file as --junit x");
    assert_refused(state, "diff a a --junit x --markdown a/../x", "--markdown a/../x is the same file as --junit x");
    assert_refused(state, "diff a a -o ev --junit ev/report.html", "--junit ev/report.html is the same file as -o ev/");
    do_in(state, "diff a a --junit /dev/null --markdown /dev/null");
}

static void refused_comparison_writes_no_evidence(void **state)
{
    gallery_make(*state, "a", "1.png 2.png");
    do_in(state, "accept a.dig a --reason x && mkdir none nil");
    assert_refused(state, "diff a a/1.png -o ev", "cannot compare a picture with a folder");
    assert_refused(state, "diff none nil -o ev", "nothing to compare");
    assert_refused(state, "diff a.dig a --max-pixels 1 -o ev", "a baseline holds digests, which allow no tolerance");
}

/* Without the text layer the frame itself does not report it. */
static void record_reports_elements_left_out_by_lod(void **state)
{
    static const char sentence[] = "\n2 frames leave out nodes smaller than --lod\n";
    static const char session[] = "{\"octreel\": \"session\", \"version\": 2, \"ticks\": 1, \"points\": {\"sample\": "
                                  "\"clustered\", \"count\": 2000, \"seed\": 1}}";
    file_write_text(place_in(*state, "s.json").path, session);
    do_in(state, "record s.json --size 64x36 --layers -text -o film >said");
    assert_has_text(state, "said", sentence, true);
    do_in(state, "record s.json --size 64x36 --layers -text --lod 0 -o whole >said");
    assert_has_text(state, "said", "--lod", false);
    do_in(state, "record s.json --size 64x36 --layers -text --json -o json >said");
    assert_has_text(state, "said", "\"below_lod\": 2", true);
}

static void inspect_reports_elements_left_out_by_lod_once(void **state)
{
    FILE *out = fopen(place_in(*state, "p").path, "w");
    assert_non_null(out);
    for (int i = 0; i < 500; i++)
        fprintf(out, "%d %d %d\n", i * i % 97, i * 7 % 89, i * i * i % 83);
    assert_int_equal(fclose(out), 0);
    static const char inspect[] = "inspect p --capacity 1 --size 64x36 -o t.png --json %s 2>said >/dev/null";
    static const struct {
        const char *options;
        bool told;
    } rows[] = {{"--layers -text", true}, {"", false}, {"--layers -text --lod 0", false}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[160];
        snprintf(line, sizeof line, inspect, rows[i].options);
        do_in(state, line);
        assert_has_text(state, "said", "octreel: t.png leaves out nodes smaller than --lod\n", rows[i].told);
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    unsetenv("CI"); /* accept refuses to run if CI is set */
    const struct CMUnitTest tests[] = {
        IN_FOLDER(cloud_is_not_overwritten),
        IN_FOLDER(two_outputs_of_inspect_must_be_different_files),
        IN_FOLDER(recording_files_are_not_overwritten),
        IN_FOLDER(reports_overwrite_no_compared_file),
        IN_FOLDER(two_reports_must_be_different_files),
        IN_FOLDER(refused_comparison_writes_no_evidence),
        IN_FOLDER(record_reports_elements_left_out_by_lod),
        IN_FOLDER(inspect_reports_elements_left_out_by_lod_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
