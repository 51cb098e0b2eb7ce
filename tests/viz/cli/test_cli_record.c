/* SPDX-License-Identifier: MIT */
/* test_cli_record.c - octreel and octreel record: arguments, output and refused input. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "recordings.h"
#include "session_file.h"
#include "tick_lines.h"

#define SMALL "--size 160x90"
#define HEADER "{\"octreel\": \"session\", \"version\": 2,\n"

static void assert_says(const char *arguments, const char *part)
{
    command_result result = run_octreel(NULL, "%s", arguments);
    assert_done(&result);
    if (strstr(result.out, part) == NULL)
        fail_msg("octreel %s says \"%s\" and not \"%s\"", arguments, result.out, part);
    command_release(&result);
}

static void help_is_printed_on_stdout(void **state)
{
    (void)state;
    assert_says("--help", "record");
    assert_says("-h", "inspect");
    assert_says("record --help", "--every");
    assert_says("record -h", "--keys");
    assert_says("inspect --help", "--capacity");
    assert_says("inspect -h", "--nodes");
}

static void version_names_the_renderer(void **state)
{
    (void)state;
    assert_says("--version", "octreel ");
    assert_says("--version", "llvmpipe");
}

static void missing_command_prints_help_on_stderr(void **state)
{
    (void)state;
    command_result result = run_octreel(NULL, "%s", "");
    assert_int_equal(result.status, 2);
    assert_string_equal(result.out, "");
    assert_non_null(strstr(result.err, "record"));
    command_release(&result);
}

static void unknown_and_incomplete_options_are_refused(void **state)
{
    static const char *const arguments[] = {"record --bogus -o", "record -x -o", "inspect --bogus -o"};
    const place folder = place_in(*state, "film");
    for (size_t i = 0; i < sizeof arguments / sizeof arguments[0]; i++) {
        command_result result = run_octreel(NULL, "%s %s", arguments[i], folder.path);
        assert_trouble(&result,
                       i == 1 ? "unknown option -x; octreel record --help" : "unknown option --bogus; octreel");
    }
    command_result result = run_octreel(NULL, "record -o");
    assert_int_equal(result.status, 2);
    assert_string_equal(result.out, "");
    command_release(&result);
    assert_int_equal(temp_folder_count(*state), 0);
}

static void invalid_values_are_refused_in_one_sentence(void **state)
{
    static const char *const rows[][2] = {
        {"--size 0x0", "1 to 16384"},
        {"--size 160x0", "1 to 16384"},
        {"--size 16385x1", "1 to 16384"},
        {"--size 99999x99999", "1 to 16384"},
        {"--size 99999999999999999999x1", "99999999999999999999x1"},
        {"--size -160x90", "-160x90"},
        {"--size 160", "160"},
        {"--size 160x", "160x"},
        {"--size 160x90x", "160x90x"},
        {"--size 160X90", "160X90"},
        {"--size=", "--size"},
        {"--camera up", "unknown camera \"up\"; choose from iso, top, front, side, follow, orbit"},
        {"--camera=", "camera"},
        {"--color-by rainbow", "unknown colour mode \"rainbow\"; choose from depth, occupancy, plain"},
        {"--slice 100", "z=100"},
        {"--slice w=1", "w=1"},
        {"--slice z=", "z="},
        {"--slice z=1x", "z=1x"},
        {"--slice z=nan", "z=nan"},
        {"--slice z=1000.5", "z = 1000.5 lies outside the world, which extends from -1000 to 1000"},
        {"--depths 5:2", "5:2"},
        {"--depths :", "2:5"},
        {"--depths=", "2:5"},
        {"--depths 1:22", "0 to 21"},
        {"--depths 6:9", "the deepest level of the tree is 5"},
        {"--lod -1", "pixels from 0 to 16384"},
        {"--lod many", "many"},
        {"--lod 1e9", "1e9"},
        {"--budget -1", "-1"},
        {"--budget 1e6", "1e6"},
        {"--region 1,2,3", "six numbers"},
        {"--region 0,0,0,1,-1,1", "min must not be above max"},
        {"--region 2000,0,0,3000,1,1", "on axis x the region extends from 2000 to 3000"},
        {"--layers nodes,walls", "unknown layer \"walls\"; choose from world, nodes, visit-heat, "},
        {"--layers nodes,,text", "layer"},
        {"--layers=", "layer"},
        {"--layers --", "layer"},
        {"--every 0", "--every"},
        {"--every -1", "-1"},
        {"--every 1.5", "1.5"},
        {"--every 18446744073709551616", "18446744073709551616"},
        {"--every two", "two"},
        {"--keys wwx", "key 3"},
        {"--keys W", "'W'"},
    };
    const place folder = place_in(*state, "film");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_octreel(NULL, "record -o %s %s", folder.path, rows[i][0]);
        assert_trouble(&result, rows[i][1]);
        assert_false(file_exists(folder.path));
    }
}

static void contradicting_arguments_are_refused_in_one_sentence(void **state)
{
    static const char *const rows[][2] = {{"bogus", "\"bogus\""},
                                          {"rec", "\"rec\""},
                                          {"record", "-o"},
                                          {"record --json", "-o"},
                                          {"record a.json", "a.json: no such file"},
                                          {"record a.json b.json -o x", "b.json"},
                                          {"record --output=", "empty"},
                                          {"record absent.json -o x", "absent.json"}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_octreel(NULL, "%s", rows[i][0]);
        assert_trouble(&result, rows[i][1]);
        assert_false(file_exists("x"));
    }
}

static void bad_sessions_are_refused_with_file_line_and_reason(void **state)
{
    static const char *const rows[][2] = {
        {"", "s.json:1: holds no session"},
        {"nonsense", "s.json:1: "},
        {HEADER "\"keys\": \"ww", "s.json:2: "},
        {HEADER "\"keyz\": 1}", "s.json:2: unknown member \"keyz\""},
        {HEADER "\"keys\": \"wx\"}", "s.json:2: keys: key 2"},
        {HEADER "\"world\": {\"min\": [0, 0, 0],\n\"max\": [1, 0, 1]}}", "s.json:2: world: min must be below max"},
        {HEADER "\"player\":\n{\"step\": -1}}", "s.json:3: player.step"},
        {HEADER "\"player\": {\"box_size\": -0.5}}", "s.json:2: player.box_size"},
        {HEADER "\"player\": {\"position\": [0, 2000, 0]}}",
         "the player is outside the world; correct its coordinate y"},
        {HEADER "\"points\": [[1, 2, NaN]]}", "s.json:2: "},
        {HEADER "\"points\": [[1, 2, 1e999]]}", "s.json:2: "},
        {HEADER "\"points\": [\n[1, 2]]}", "s.json:3: points[0]"},
        {HEADER "\"points\": [[1, 2, 3, 7],\n[4, 5, 6, 7]]}", "s.json:3: points[1]: id 7"},
        {HEADER "\"points\": {\"file\": \"absent.txt\"}}", "absent.txt: "},
        {HEADER "\"points\": {\"file\": \"bad.txt\"}}", "bad.txt:2: "},
        {HEADER "\"points\": {\"sample\": \"fog\", \"count\": 3}}", "s.json:2: "},
        {HEADER "\"tree\": {\"capacity\": 0}}", "s.json:2: tree.capacity"},
        {HEADER "\"ticks\": -1}", "s.json:2: ticks"},
        {HEADER "\"ticks\": 1}\n{\"tick\": 1, \"edits\": [{\"remove\": -1}]}", "s.json:3: "},
        {"{\"octreel\": \"session\", \"version\": 3}", "s.json:1: version"},
        {"[]", "s.json:1: "},
    };
    const place session = place_in(*state, "s.json"), folder = place_in(*state, "film");
    file_write_text(place_in(*state, "bad.txt").path, "1 2 3\n4 five 6\n");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        file_write_text(session.path, rows[i][0]);
        command_result result = run_octreel(NULL, "record %s -o %s", session.path, folder.path);
        assert_trouble(&result, rows[i][1]);
        assert_false(file_exists(folder.path));
    }
}

static void session_must_be_a_regular_file(void **state)
{
    const temp_folder *own = *state;
    const place folder = place_in(own, "film");
    command_result result = run_octreel(NULL, "record %s -o %s", own->name, folder.path);
    assert_trouble(&result, own->name);
    result = run_octreel(NULL, "record /dev/null -o %s", folder.path);
    assert_trouble(&result, "/dev/null");
    assert_int_equal(temp_folder_count(own), 0);
}

static void folder_with_a_recording_is_refused_and_unchanged(void **state)
{
    const place folder = place_in(*state, "film"), copy = place_in(*state, "copy");
    const char *const folders[] = {folder.path, copy.path};
    for (size_t i = 0; i < 2; i++) {
        command_result result = run_octreel(NULL, "record --keys=w " SMALL " -o %s", folders[i]);
        assert_done(&result);
        command_release(&result);
    }
    command_result result = run_octreel(NULL, "record --keys=d " SMALL " -o %s", folder.path);
    assert_non_null(strstr(result.err, folder.path));
    assert_non_null(strstr(result.err, "--resume"));
    assert_non_null(strstr(result.err, "--replace"));
    assert_non_null(strstr(result.err, "(-o)"));
    assert_null(strstr(result.err, "frame_"));
    assert_trouble(&result, "already holds a recording");
    assert_same_folders(folder.path, copy.path, NULL);
}

/* The session file is in the folder for the recording, under the name session.json. */
static void session_in_the_output_folder_is_unchanged(void **state)
{
    const place folder = place_in(*state, "film"), session = place_in(*state, "film/session.json");
    static const char text[] = HEADER "\"points\": {\"sample\": \"uniform\", \"count\": 5}, \"keys\": \"w\"}\n";
    assert_int_equal(mkdir(folder.path, 0777), 0);
    file_write_text(session.path, text);
    command_result result = run_octreel(NULL, "record %s " SMALL " -o %s", session.path, folder.path);
    char *left = file_read(session.path, NULL);
    assert_string_equal(left, text);
    free(left);
    assert_trouble(&result, "session.json");
}

static void unusable_output_folders_are_refused_in_one_sentence(void **state)
{
    const place file = place_in(*state, "file");
    file_write_text(file.path, "mine");
    command_result result = run_octreel(NULL, "record -o %s", file.path);
    assert_trouble(&result, file.path);
    result = run_octreel(NULL, "record -o %s/film", file.path);
    assert_trouble(&result, file.path);
    result = run_octreel(NULL, "record -o /proc/octreel_test/film");
    assert_trouble(&result, "/proc/octreel_test");
    assert_int_equal(temp_folder_count(*state), 1);
}

static void json_summary_is_one_object_that_agrees_with_the_recording(void **state)
{
    const place folder = place_in(*state, "film");
    command_result result = run_octreel(NULL, "record " SMALL " --every 50 --json -o %s", folder.path);
    assert_done(&result);
    assert_ptr_equal(strchr(result.out, '\n'), result.out + strlen(result.out) - 1);
    json_t *summary = json_read(result.out);
    assert_members(summary, "folder ticks frames gaps left_out checked checked_by over_budget below_lod refusals "
                            "seconds frames_per_second events");
    assert_string_equal(json_string_value(json_member(summary, "folder")), folder.path);
    assert_whole_number(json_member(summary, "ticks"), 253);
    assert_whole_number(json_member(summary, "frames"), 6);
    assert_whole_number(json_member(summary, "gaps"), 0);
    assert_whole_number(json_member(summary, "left_out"), 0);
    assert_true(json_real_value(json_member(summary, "seconds")) > 0);
    assert_members(json_member(summary, "events"), "moved refused collided full split merged wrong overlapped");
    json_decref(summary);
    command_release(&result);
}

/* Also if the text layer is off, so that the frame does not report it. */
static void frames_over_budget_are_reported(void **state)
{
    const place film = place_in(*state, "film"), points = place_in(*state, "p.txt"),
                picture = place_in(*state, "p.png"), session = place_in(*state, "s.json"),
                arrows = place_in(*state, "arrows");
    command_result result =
        run_octreel(NULL, "record --every 100 --budget 5 --layers -text " SMALL " -o %s", film.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "3 frames leave out nodes and points beyond --budget"));
    command_release(&result);
    file_write_text(session.path,
                    "{\"octreel\": \"session\", \"version\": 2, \"velocities\": {\"speed\": 40, \"seed\": 1},"
                    " \"points\": {\"sample\": \"uniform\", \"count\": 40, \"seed\": 1}, \"ticks\": 1}");
    result =
        run_octreel(NULL, "record %s --budget 1000 --layers velocities " SMALL " -o %s", session.path, arrows.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "2 frames leave out velocity arrows beyond --budget")); /* all frames but one */
    command_release(&result);
    file_write_text(points.path, "1 2 3\n4 5 6\n7 8 9\n");
    result = run_octreel(NULL, "inspect %s --budget 1 --layers points " SMALL " -o %s", points.path, picture.path);
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.err, "leaves out points beyond --budget"));
    command_release(&result);
}

/* The notes go to stderr, because stdout may be data. */
static void view_options_without_effect_are_reported(void **state)
{
    const place film = place_in(*state, "film"), points = place_in(*state, "p.txt"),
                picture = place_in(*state, "p.png");
    command_result result = run_octreel(
        NULL, "record --every 100 " SMALL " --color-points class --tree foreign --color-by kind -o %s", film.path);
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.err, "octreel: no point has a class: --color-points class shows all points alike\n"));
    assert_non_null(
        strstr(result.err, "octreel: no tick has nodes of a foreign index, so --tree foreign shows no nodes\n"));
    assert_non_null(strstr(result.err, "--color-by kind shows all nodes alike\n"));
    command_release(&result);
    file_write_text(points.path, "x y z class\n1 2 3 2\n4 5 6 2\n7 8 9 6\n");
    result = run_octreel(NULL, "inspect %s --color-points class " SMALL " -o %s", points.path, picture.path);
    assert_done(&result);
    assert_string_equal(result.err, "");
    command_release(&result);
    result = run_octreel(NULL, "inspect %s --color-points intensity " SMALL " -o %s", points.path, picture.path);
    assert_non_null(strstr(result.err, "no point has an intensity: --color-points intensity shows all points alike\n"));
    assert_non_null(strstr(result.out, "points in one colour, because none has an intensity (--color-points)"));
    command_release(&result);
}

static void keys_option_replaces_the_keys_of_the_session(void **state)
{
    const place folder = place_in(*state, "film");
    session_file played;
    octreel_error error;
    command_result result = run_octreel(NULL, "record --keys eenqww " SMALL " -o %s", folder.path);
    assert_done(&result);
    command_release(&result);
    assert_true(session_read(place_below(folder.path, "session.json").path, &played, &error));
    assert_string_equal(played.session.keys, "eenqww");
    session_release(&played);
    assert_true(file_exists(place_below(folder.path, "frame_000003.png").path));
    assert_false(file_exists(place_below(folder.path, "frame_000004.png").path)); /* q ends the session */
}

static void progress_is_silent_without_a_terminal(void **state)
{
    const place quiet = place_in(*state, "quiet");
    command_result result = run_octreel(NULL, "record " SMALL " -o %s", quiet.path);
    assert_done(&result);
    command_release(&result);
}

static void progress_is_shown_on_a_terminal(void **state)
{
    static const command_setting terminal = {.terminal = true};
    if (!command_has_terminals()) {
        print_message("this container has no /dev/pts: progress on a terminal is not tested\n");
        skip();
    }
    const place quiet = place_in(*state, "quiet"), shown = place_in(*state, "shown");
    command_result result = run_octreel(NULL, "record " SMALL " -o %s", quiet.path);
    command_release(&result);
    result = run_octreel(&terminal, "record " SMALL " -o %s", shown.path);
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.err, "253/253 ticks"));
    assert_non_null(strstr(result.err, "/s"));
    assert_non_null(strstr(result.err, "s left"));
    assert_null(strchr(result.err, '\n')); /* one line, overwritten each time and finally erased */
    assert_string_equal(result.err + strlen(result.err) - 2, " \r");
    assert_null(strchr(result.err, '\033'));
    assert_null(strchr(result.out, '\r'));
    command_release(&result);
    assert_same_folders(quiet.path, shown.path, NULL);
}

/* Refused points are events of tick 0 and no error. */
static void points_that_full_leaves_refuse_are_refusals_of_tick_0(void **state)
{
    enum { COUNT = 20000 };
    const place session = place_in(*state, "s.json"), points = place_in(*state, "p.txt"), film = place_in(*state, "f");
    char *text = malloc(COUNT * 6 + 1);
    assert_non_null(text);
    for (size_t i = 0; i < COUNT; i++)
        strcpy(text + 6 * i, "1 2 3\n");
    file_write_text(points.path, text);
    free(text);
    file_write_text(session.path, HEADER "\"points\": {\"file\": \"p.txt\"}, \"ticks\": 1,\n"
                                         "\"world\": {\"min\": [-9, -9, -9], \"max\": [9, 9, 9]}}\n");
    command_result result = run_octreel(NULL, "record %s " SMALL " -o %s", session.path, film.path);
    assert_int_equal(result.status, 0);
    assert_string_equal(result.err,
                        "octreel: 19992 of the session's 20000 points are refused by full leaves; \"tree\": "
                        "{\"full\": \"grow\"} keeps them\n");
    command_release(&result);
    char *lines = file_read(place_below(film.path, "ticks.jsonl").path, NULL);
    *strchr(lines, '\n') = '\0';
    json_t *first = json_read(lines);
    assert_int_equal(json_array_size(json_member(first, "refusals")), COUNT - 8);
    assert_whole_number(json_member(json_member(first, "tree"), "points"), 9);
    json_decref(first);
    free(lines);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(help_is_printed_on_stdout),
        cmocka_unit_test(version_names_the_renderer),
        cmocka_unit_test(missing_command_prints_help_on_stderr),
        IN_FOLDER(unknown_and_incomplete_options_are_refused),
        IN_FOLDER(invalid_values_are_refused_in_one_sentence),
        cmocka_unit_test(contradicting_arguments_are_refused_in_one_sentence),
        IN_FOLDER(bad_sessions_are_refused_with_file_line_and_reason),
        IN_FOLDER(session_must_be_a_regular_file),
        IN_FOLDER(folder_with_a_recording_is_refused_and_unchanged),
        IN_FOLDER(session_in_the_output_folder_is_unchanged),
        IN_FOLDER(unusable_output_folders_are_refused_in_one_sentence),
        IN_FOLDER(json_summary_is_one_object_that_agrees_with_the_recording),
        IN_FOLDER(frames_over_budget_are_reported),
        IN_FOLDER(view_options_without_effect_are_reported),
        IN_FOLDER(keys_option_replaces_the_keys_of_the_session),
        IN_FOLDER(progress_is_silent_without_a_terminal),
        IN_FOLDER(progress_is_shown_on_a_terminal),
        IN_FOLDER(points_that_full_leaves_refuse_are_refusals_of_tick_0),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
