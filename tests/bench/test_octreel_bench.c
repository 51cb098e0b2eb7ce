/* SPDX-License-Identifier: MIT */
/* test_octreel_bench.c - what octreel-bench says of a filming of a few frames: its times mean nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "temp_folder.h"
#include "tick_lines.h"

static command_result run_bench(const char *arguments)
{
    return run_script("%s %s", shell_quote(OCTREEL_BENCH).text, arguments);
}

static void json_tells_who_filmed_what_how_fast(void **state)
{
    static const char *const who[] = {"naive", "octreel"};
    (void)state;
    command_result run = run_bench("--json --scene S --frames 6 --rounds 1 --folder .");
    assert_done(&run);
    const char *line = strtok(run.out, "\n");
    for (int i = 0; i < 2; i++, line = strtok(NULL, "\n")) {
        assert_non_null(line);
        json_t *told = json_read(line);
        assert_string_equal(json_string_value(json_member(told, "scene")), "S");
        assert_string_equal(json_string_value(json_member(told, "who")), who[i]);
        static const char *const positive[] = {"fps", "draw_ms", "encode_ms", "times_naive", "first_frame_ms", "mib"};
        for (size_t j = 0; j < sizeof positive / sizeof positive[0]; j++)
            assert_true(json_number_value(json_member(told, positive[j])) > 0);
        json_decref(told);
    }
    assert_null(line);
    command_release(&run);
}

static void table_holds_every_figure_against_its_goal(void **state)
{
    (void)state;
    command_result run = run_bench("--scene S --frames 6 --rounds 1 --folder .");
    assert_done(&run);
    const char *row = strstr(run.out, "octreel");
    assert_non_null(row);
    row = strstr(row, ">= 10x ");
    assert_non_null(row);
    assert_non_null(strstr(row, "<300 "));
    assert_non_null(strstr(row, "<200 "));
    command_release(&run);
}

static void nothing_is_left_of_its_frames(void **state)
{
    temp_folder *folder = *state;
    char arguments[128];
    snprintf(arguments, sizeof arguments, "--scene S --frames 6 --rounds 1 --folder %s", folder->name);
    command_result run = run_bench(arguments);
    assert_done(&run);
    assert_int_equal(temp_folder_count(folder), 0);
    command_release(&run);
}

static void unknown_words_are_refused_with_a_sentence(void **state)
{
    static const char *const wrong[] = {"--json --scene XXL", "--json --frames 2", "--json --rounds 0",
                                        "--json --folder /no/such/folder", "--json word"};
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        command_result run = run_bench(wrong[i]);
        assert_int_equal(run.status, 2);
        assert_string_equal(run.out, "");
        assert_int_equal(strncmp(run.err, "octreel-bench: ", 15), 0);
        assert_ptr_equal(strchr(run.err, '\n'), run.err + strlen(run.err) - 1);
        command_release(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(json_tells_who_filmed_what_how_fast),
        cmocka_unit_test(table_holds_every_figure_against_its_goal),
        cmocka_unit_test_setup_teardown(nothing_is_left_of_its_frames, temp_folder_make, temp_folder_remove),
        cmocka_unit_test(unknown_words_are_refused_with_a_sentence),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
