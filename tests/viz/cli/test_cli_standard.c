/* SPDX-License-Identifier: MIT */
/* test_cli_standard.c - "-" is standard input for an input file and standard output for an output file, with the same
 * bytes. */
#define _XOPEN_SOURCE 700 /* pseudo terminals */

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "las_files.h"
#include "page.h"

static const char points[] = "0 0 0\n1 2 3\n4 5 6\n";
static const char session[] = "{\"octreel\":\"session\",\"version\":2,\"points\":{\"sample\":\"uniform\",\"count\":9,"
                              "\"seed\":1},\"keys\":\"wd\",\"queries\":[{\"nearest\":[-999,0,0],\"answer\":[77]}]}\n";

/* Run shell lines in the folder of the test, with octreel's path in $octreel. */
static command_result run_lines(void **state, const char *lines)
{
    const temp_folder *own = *state;
    return run_script("octreel=%s && cd %s && %s", octreel_program(), own->name, lines);
}

static void assert_lines_done(void **state, const char *lines)
{
    command_result result = run_lines(state, lines);
    assert_done(&result);
    command_release(&result);
}

static void cloud_format_is_found_from_the_content(void **state)
{
    file_write_text(place_in(*state, "standard input").path, points); /* a file with this name must not be read */
    assert_lines_done(state, "\"$octreel\" inspect 'standard input' --nodes nodes --nearest 1,2,2 >a && "
                             "cat 'standard input' | \"$octreel\" inspect - --nearest 1,2,2 >b && tail -n +3 b >c && "
                             "test -s b && grep -v '^wrote' a | cmp - b && "
                             "cat 'standard input' | \"$octreel\" inspect - --nodes - 2>d | cmp - nodes && "
                             "grep -q 'wrote standard output: all nodes' d");
}

static void clouds_of_each_format_are_read_from_a_pipe(void **state)
{
    static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
                              "property double z\nend_header\n1 2 3\n4 5 6\n",
                      pcd[] = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nPOINTS 2\nDATA binary\n"
                              "abcdefghijkl@bcdefghijkl",
                      text[] = "x,y,z\n1,2,3\n4,5,6\n";
    const bytes las = make_las_file(&two);
    const struct {
        const void *data;
        size_t size;
    } rows[] = {{ply, sizeof ply - 1}, {pcd, sizeof pcd - 1}, {text, sizeof text - 1}, {las.data, las.size}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        file_write(place_in(*state, "standard input").path, rows[i].data, rows[i].size);
        assert_lines_done(state, "\"$octreel\" inspect 'standard input' --json >a && grep -q '\"points\": 2,' a && "
                                 "cat 'standard input' | \"$octreel\" inspect - --json | cmp - a");
    }
}

static void picture_is_the_only_standard_output(void **state)
{
    file_write_text(place_in(*state, "standard input").path, points);
    assert_lines_done(state, "\"$octreel\" inspect 'standard input' -o a.png --size 64x36 >a && "
                             "\"$octreel\" inspect - -o - --size 64x36 <'standard input' 2>b | cmp - a.png && "
                             "sed 's/wrote a.png/wrote standard output/' a | cmp - b");
}

static void picture_is_not_written_to_a_terminal(void **state)
{
    const place file = place_in(*state, "cloud");
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    if (terminal < 0)
        skip();
    assert_true(grantpt(terminal) == 0 && unlockpt(terminal) == 0);
    file_write_text(file.path, points);
    command_result result =
        run_octreel(&(command_setting){.output = ptsname(terminal)}, "inspect %s -o - --size 64x36", file.path);
    assert_trouble(&result, "-o - would print a PNG on the terminal");
    close(terminal);
}

static void record_reads_sessions_from_standard_input(void **state)
{
    if (!page_can_play())
        skip();
    file_write_text(place_in(*state, "octreel.json").path, session);
    assert_lines_done(state, "\"$octreel\" play octreel.json -o a.html >a && "
                             "\"$octreel\" play - -o - <octreel.json | cmp - a.html && "
                             "\"$octreel\" play - <octreel.json >b && cmp a.html octreel.html");
}

static void audit_reads_sessions_from_standard_input(void **state)
{
    file_write_text(place_in(*state, "octreel.json").path, session);
    command_result result =
        run_lines(state, "\"$octreel\" audit octreel.json | sed 's/octreel.json/standard input/' >a;"
                         " \"$octreel\" audit - <octreel.json >b; echo $? >>b; echo 1 >>a; cmp a b");
    assert_done(&result);
    command_release(&result);
}

static void diff_reads_pictures_and_baselines_from_standard_input(void **state)
{
    file_write_text(place_in(*state, "s.json").path, session);
    assert_lines_done(state, "unset CI && \"$octreel\" record s.json --size 32x18 -o r >b && "
                             "\"$octreel\" accept a r --reason x >b && \"$octreel\" diff - r <a >b && "
                             "\"$octreel\" diff r - <a >b && cat r/frame_000001.png | "
                             "\"$octreel\" diff - r/frame_000001.png >b && "
                             "\"$octreel\" accept new.png - <r/frame_000001.png >b && cmp new.png r/frame_000001.png");
}

static void evidence_contains_the_picture_from_standard_input(void **state)
{
    file_write_text(place_in(*state, "s.json").path, session);
    assert_lines_done(state,
                      "\"$octreel\" record s.json --size 32x18 -o r >a && "
                      "{ \"$octreel\" diff r/frame_000000.png - -o e <r/frame_000001.png >b || test $? = 1; } && "
                      "cmp e/*.actual.png r/frame_000001.png && cmp e/*.expected.png r/frame_000000.png");
}

static void errors_about_standard_input_name_it(void **state)
{
    static const char *const rows[][2] = {
        {"\"$octreel\" inspect - </dev/null", "standard input: holds no points"},
        {"echo 1 2 x | \"$octreel\" inspect -", "standard input:1: 'x' is not a number"},
        {"echo 1 2 3 | \"$octreel\" diff - s.json", "standard input: not a PNG file, a folder, or a baseline"},
        {"\"$octreel\" diff - s.json </dev/null", "standard input: not a PNG file"},
        {"echo 1 2 3 | \"$octreel\" audit -", "standard input:1: '{' expected near '1'"},
        {"\"$octreel\" audit - <.", "standard input: cannot be read: Is a directory"},
    };
    file_write_text(place_in(*state, "s.json").path, "octreel-digests 2\nbackground ffffff\n");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_lines(state, rows[i][0]);
        assert_trouble(&result, rows[i][1]);
    }
}

/* A session in the current folder may name the file "-" without "./". */
static void file_named_dash_is_read_by_its_path(void **state)
{
    file_write_text(place_in(*state, "-").path, points);
    file_write_text(place_in(*state, "s.json").path,
                    "{\"octreel\":\"session\",\"version\":2,\"points\":{\"file\":\"-\"}}");
    assert_lines_done(state, "\"$octreel\" record - --no-frames -o a <s.json >b && grep -q '4, 5, 6' a/session.json && "
                             "\"$octreel\" inspect ./- >b");
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(cloud_format_is_found_from_the_content),
        IN_FOLDER(clouds_of_each_format_are_read_from_a_pipe),
        IN_FOLDER(picture_is_the_only_standard_output),
        IN_FOLDER(picture_is_not_written_to_a_terminal),
        IN_FOLDER(record_reads_sessions_from_standard_input),
        IN_FOLDER(audit_reads_sessions_from_standard_input),
        IN_FOLDER(diff_reads_pictures_and_baselines_from_standard_input),
        IN_FOLDER(evidence_contains_the_picture_from_standard_input),
        IN_FOLDER(errors_about_standard_input_name_it),
        IN_FOLDER(file_named_dash_is_read_by_its_path),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
