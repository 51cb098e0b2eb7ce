/* SPDX-License-Identifier: MIT */
/* test_cli_progress.c - the progress bar fits terminals of every width, and is not shown on terminals that cannot
 * overwrite a line. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"

static command_result film_on(void **state, const command_setting *terminal)
{
    static int count;
    char name[16];
    if (!command_has_terminals()) {
        print_message("this container has no /dev/pts: progress on a terminal is not tested\n");
        skip();
    }
    snprintf(name, sizeof name, "film%d", count++);
    command_result result = run_octreel(terminal, "record --keys wdn --size 32x32 -o %s", place_in(*state, name).path);
    assert_int_equal(result.status, 0);
    return result;
}

/* The greatest width of a line on the screen: each carriage return starts a line again. */
static size_t measure(const char *text)
{
    size_t longest = 0;
    for (const char *at = text; *at != '\0';) {
        assert_int_equal(*at++, '\r');
        const size_t length = strcspn(at, "\r\033");
        assert_int_not_equal(at[length], '\033'); /* not every terminal supports escape sequences */
        longest = length > longest ? length : longest;
        at += length;
    }
    return longest;
}

static void line_is_narrower_than_the_terminal(void **state)
{
    static const unsigned widths[] = {200, 80, 45, 30, 10, 2, 1};
    for (size_t i = 0; i < sizeof widths / sizeof widths[0]; i++) {
        command_result result = film_on(state, &(command_setting){.terminal = true, .columns = widths[i]});
        const size_t longest = measure(result.err);
        if (longest >= widths[i])
            fail_msg("%zu characters on a terminal of %u columns", longest, widths[i]);
        assert_int_equal(strstr(result.err, "4/4 ticks") != NULL, widths[i] >= 10);
        assert_int_equal(strstr(result.err, "[####") != NULL, widths[i] >= 45);
        command_release(&result);
    }
}

static void terminal_of_unknown_width_has_80_columns(void **state)
{
    command_result result = film_on(state, &(command_setting){.terminal = true});
    const size_t width = measure(result.err);
    assert_true(width >= 40 && width <= 79);
    command_release(&result);
}

static void dumb_terminal_shows_no_progress(void **state)
{
    static const char *const terms[] = {"TERM=dumb", "TERM="};
    for (size_t i = 0; i < 2; i++) {
        command_result result = film_on(state, &(command_setting){.terminal = true, .environment = {terms[i]}});
        assert_string_equal(result.err, "");
        command_release(&result);
    }
}

/* A small text is a single block. */
static void input_from_a_pipe_is_counted_by_large_blocks(void **state)
{
    const place fifo = place_in(*state, "fifo"), cloud = place_in(*state, "cloud");
    if (!command_has_terminals())
        skip();
    file_write_text(cloud.path, "1 2 3\n4 5 6\n");
    assert_int_equal(mkfifo(fifo.path, 0600), 0);
    char line[2100];
    snprintf(line, sizeof line, "cat %s >%s &", cloud.path, fifo.path);
    assert_int_equal(system(line), 0);
    command_result result =
        run_octreel(&(command_setting){.terminal = true, .columns = 80, .input = fifo.path}, "inspect -");
    assert_int_equal(result.status, 0);
    const char *first = strstr(result.err, "\r0 kB read");
    assert_non_null(first);
    assert_null(strstr(first + 1, "\r0 kB read"));
    command_release(&result);
}

/* The length of standard input is unknown. */
static void ticks_of_a_stream_are_counted(void **state)
{
    const place session = place_in(*state, "session"), film = place_in(*state, "film");
    if (!command_has_terminals())
        skip();
    file_write_text(session.path, "{\"octreel\":\"session\",\"version\":2}\n{\"tick\":3}\n");
    command_result result = run_octreel(&(command_setting){.terminal = true, .columns = 80, .input = session.path},
                                        "record - --size 16x16 -o %s", film.path);
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.err, "\r1 ticks  "));
    assert_null(strstr(result.err, "left"));
    assert_null(strstr(result.err, "[#"));
    command_release(&result);
}

static void reading_and_building_a_cloud_show_progress(void **state)
{
    const place cloud = place_in(*state, "cloud");
    char text[4001] = "";
    if (!command_has_terminals())
        skip();
    for (int i = 0; i < 500; i++)
        snprintf(text + 8 * i, 9, "%3d 1 2\n", i);
    file_write_text(cloud.path, text);
    for (int from_standard_input = 0; from_standard_input < 2; from_standard_input++) {
        command_result result = run_octreel(&(command_setting){.terminal = true, .columns = 80, .input = cloud.path},
                                            "inspect %s -o %s --size 16x16", from_standard_input ? "-" : cloud.path,
                                            place_in(*state, "tree.png").path);
        assert_int_equal(result.status, 0);
        assert_non_null(strstr(result.err, "4/4 kB read"));
        assert_non_null(strstr(result.err, "500/500 points inserted"));
        assert_non_null(strstr(result.err, "drawing "));
        command_release(&result);
    }
}

static void audit_counts_ticks(void **state)
{
    const place session = place_in(*state, "session.json");
    if (!command_has_terminals())
        skip();
    file_write_text(session.path, "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[1,0,0,1]],"
                                  "\"queries\":[{\"nearest\":[0,0,0],\"answer\":[1]}],\"ticks\":9}\n");
    command_result result = run_octreel(&(command_setting){.terminal = true}, "audit %s", session.path);
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.err, "10/10 ticks"));
    command_release(&result);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(line_is_narrower_than_the_terminal),
        IN_FOLDER(terminal_of_unknown_width_has_80_columns),
        IN_FOLDER(dumb_terminal_shows_no_progress),
        IN_FOLDER(input_from_a_pipe_is_counted_by_large_blocks),
        IN_FOLDER(ticks_of_a_stream_are_counted),
        IN_FOLDER(reading_and_building_a_cloud_show_progress),
        IN_FOLDER(audit_counts_ticks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
