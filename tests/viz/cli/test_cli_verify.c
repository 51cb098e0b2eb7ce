/* SPDX-License-Identifier: MIT */
/* test_cli_verify.c - octreel verify: output and exit status. */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "renderer.h"
#include "edits.h"
#include "tick_lines.h"
#include "verified.h"

static void identical_recording_prints_one_line(void **state)
{
    const place folder = film_short(*state);
    char line[2048];
    snprintf(line, sizeof line, "%s: identical: 14 ticks, 5 frames\n", folder.path);
    command_result result = run_octreel(NULL, "verify %s", folder.path);
    assert_done(&result);
    assert_string_equal(result.out, line);
    command_release(&result);
}

static void recording_is_identical_with_every_context(void **state)
{
    const place folder = place_in(*state, "film");
    command_result result =
        run_octreel(NULL, "record --keys wdn --size 320x180 --camera follow --aa 2 --every 2 -o %s", folder.path);
    assert_done(&result);
    command_release(&result);
    for (int kind = 0; kind < DRAW_CONTEXTS; kind++) {
        const char *name = draw_context_name(kind);
        result = run_octreel(NULL, "verify %s --context %s", folder.path, name);
        if (draw_context_is_built((draw_context)kind)) {
            assert_done(&result);
            assert_non_null(strstr(result.out, "identical"));
            command_release(&result);
        } else {
            assert_trouble(&result, name);
        }
    }
}

static void one_tick_is_reported_in_the_singular(void **state)
{
    const place folder = place_in(*state, "film"), session = place_in(*state, "one.json");
    file_write_text(session.path, "{\"octreel\": \"session\", \"version\": 2}");
    command_result result = run_octreel(NULL, "record %s --size 64x48 -o %s", session.path, folder.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, ": 1 tick, 1 frame, "));
    command_release(&result);
    result = run_octreel(NULL, "verify %s", folder.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, ": identical: 1 tick, 1 frame\n"));
    command_release(&result);
}

static void finding_is_one_line_and_exit_status_is_1(void **state)
{
    const place folder = film_short(*state);
    char line[2048];
    edit_line(folder.path, 4, "\"events\": [", "\"events\": [\"x\", ");
    command_result result = run_octreel(NULL, "verify %s", folder.path);
    assert_int_equal(result.status, 1);
    assert_string_equal(result.err, "");
    snprintf(line, sizeof line,
             "%s: tick 4 differs in what happened: events[0] is \"x\" in ticks.jsonl, but \"moved\" when the tick is "
             "played again\n",
             folder.path);
    assert_string_equal(result.out, line);
    command_release(&result);
}

/* softpipe rounds some lines differently from llvmpipe. */
static void other_renderer_can_differ_only_in_pixels(void **state)
{
    static const command_setting softpipe = {.environment = {"GALLIUM_DRIVER=softpipe"}};
    if (!draw_context_is_built(DRAW_EGL)) {
        print_message("octreel was built without EGL: no other renderer can be tested\n");
        skip();
    }
    const place folder = film_short(*state);
    command_result result = run_octreel(&softpipe, "verify %s --context egl --any-renderer", folder.path);
    assert_string_equal(result.err, "");
    if (result.status != 0) {
        assert_int_equal(result.status, 1);
        assert_non_null(strstr(result.out, "differs, only in its pixels: "));
        assert_non_null(strstr(result.out, "now drawn by egl, softpipe"));
    }
    command_release(&result);
}

static void json_output_is_one_object(void **state)
{
    const place folder = film_short(*state);
    command_result result = run_octreel(NULL, "verify %s --json", folder.path);
    assert_done(&result);
    json_t *said = json_read(result.out);
    assert_members(said, "folder identical ticks frames gaps findings drawn_by drawn_now fill");
    assert_string_equal(json_string_value(json_member(said, "fill")), "gl"); /* with any rasterizer of the recording */
    assert_true(json_is_true(json_member(said, "identical")));
    assert_whole_number(json_member(said, "ticks"), 14);
    assert_whole_number(json_member(said, "frames"), 5);
    assert_int_equal(json_array_size(json_member(said, "findings")), 0);
    assert_non_null(strstr(json_string_value(json_member(said, "drawn_now")), "llvmpipe"));
    json_decref(said);
    command_release(&result);
    edit_line(folder.path, 4, "\"player\": [", "\"player\": [1");
    file_copy(folder.path, "frame_000003.png", "frame_000004.png");
    result = run_octreel(NULL, "verify %s --json", folder.path);
    assert_int_equal(result.status, 1);
    assert_ptr_equal(strchr(result.out, '\n'), result.out + strlen(result.out) - 1);
    said = json_read(result.out);
    assert_true(json_is_false(json_member(said, "identical")));
    const json_t *findings = json_member(said, "findings"), *first = json_array_get(findings, 0);
    assert_int_equal(json_array_size(findings), 2);
    assert_members(first, "in tick fact text");
    assert_string_equal(json_string_value(json_member(first, "in")), "facts");
    assert_string_equal(json_string_value(json_member(first, "fact")), "player");
    assert_whole_number(json_member(first, "tick"), 4);
    assert_members(json_array_get(findings, 1), "in tick text");
    json_decref(said);
    command_release(&result);
}

static void finding_without_a_tick_prints_no_tick(void **state)
{
    const place folder = film_short(*state);
    file_copy(folder.path, "frame_000003.png", "frame_last.png");
    command_result result = run_octreel(NULL, "verify %s", folder.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, ": frame_last.png is not a frame of this recording\n"));
    command_release(&result);
    result = run_octreel(NULL, "verify %s --json", folder.path);
    json_t *said = json_read(result.out);
    assert_members(json_array_get(json_member(said, "findings"), 0), "in text");
    json_decref(said);
    command_release(&result);
}

static void unverifiable_recording_is_an_error(void **state)
{
    static const command_setting softpipe = {.environment = {"GALLIUM_DRIVER=softpipe"}};
    const place folder = film_short(*state);
    static const struct {
        const char *arguments, *part;
    } rows[] = {
        {"", "one recording"},
        {"a b", "one recording"},
        {"nowhere", "nowhere: no such file or folder"},
        {"nowhere --context glx", "--context: unknown value \"glx\""},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_octreel(NULL, "verify %s", rows[i].arguments);
        assert_trouble(&result, rows[i].part);
    }
    command_result result = run_octreel(&softpipe, "verify %s", folder.path);
    assert_int_equal(result.status, 0); /* the integer rasterizer draws again, and a note says why */
    assert_non_null(strstr(result.err, "only llvmpipe"));
    command_release(&result);
    result = run_octreel(NULL, "verify %s --any-renderer", folder.path);
    assert_trouble(&result, "--context egl");
    result = run_octreel(NULL, "verify %s --size 20x20", folder.path);
    assert_int_equal(result.status, 2);
    assert_non_null(strstr(result.err, "octreel verify --help"));
    command_release(&result);
    edit_file(folder.path, "session.json", "{", "");
    result = run_octreel(NULL, "verify %s", folder.path);
    assert_trouble(&result, "session.json:1");
}

static void help_describes_the_command(void **state)
{
    (void)state;
    command_result result = run_octreel(NULL, "verify --help");
    assert_done(&result);
    assert_non_null(strstr(result.out, "usage: octreel verify RECORDING"));
    assert_non_null(strstr(result.out, "--context"));
    assert_non_null(strstr(result.out, "  0  identical\n  1  different\n  2  error"));
    assert_non_null(strstr(result.out, " gaps"));
    command_release(&result);
    result = run_octreel(NULL, "--help");
    assert_non_null(strstr(result.out, "  verify "));
    command_release(&result);
}

static void progress_is_shown_only_on_a_terminal(void **state)
{
    static const command_setting terminal = {.terminal = true};
    if (!command_has_terminals()) {
        print_message("this container has no /dev/pts: progress on a terminal is not tested\n");
        skip();
    }
    const place folder = film_short(*state);
    command_result result = run_octreel(&terminal, "verify %s", folder.path);
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.err, "14/14 ticks"));
    assert_null(strchr(result.err, '\n'));
    assert_null(strchr(result.out, '\r'));
    command_release(&result);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(identical_recording_prints_one_line),      IN_FOLDER(recording_is_identical_with_every_context),
        IN_FOLDER(one_tick_is_reported_in_the_singular),     IN_FOLDER(finding_is_one_line_and_exit_status_is_1),
        IN_FOLDER(other_renderer_can_differ_only_in_pixels), IN_FOLDER(json_output_is_one_object),
        IN_FOLDER(finding_without_a_tick_prints_no_tick),    IN_FOLDER(unverifiable_recording_is_an_error),
        cmocka_unit_test(help_describes_the_command),        IN_FOLDER(progress_is_shown_only_on_a_terminal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
