/* SPDX-License-Identifier: MIT */
/* test_octreel_bench.c - octreel-bench prints complete results for a few frames; their times mean nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "browser.h"
#include "commands.h"
#include "files.h"
#include "page.h"
#include "temp_folder.h"
#include "tick_lines.h"

static command_result run_bench(const char *arguments)
{
    return run_script("%s %s", shell_quote(OCTREEL_BENCH).text, arguments);
}

#define FILM_A_FEW "--scene S --frames 6 --rounds 1 "

/* Pages are left out, with a sentence. */
static command_result film_without_browser(const char *arguments)
{
    command_result run =
        run_script("%s --browser no-such-browser " FILM_A_FEW "%s", shell_quote(OCTREEL_BENCH).text, arguments);
    assert_int_equal(run.status, 0);
    assert_string_equal(run.err, page_can_play()
                                     ? "octreel-bench: pages are left out: there is no no-such-browser\n"
                                     : "octreel-bench: pages are left out: octreel was built without WebAssembly\n");
    return run;
}

static void assert_figures(const char *line, const char *who, const char *const *positive, size_t count)
{
    assert_non_null(line);
    json_t *told = json_read(line);
    assert_string_equal(json_string_value(json_member(told, "scene")), "S");
    assert_string_equal(json_string_value(json_member(told, "who")), who);
    for (size_t i = 0; i < count; i++)
        assert_true(json_number_value(json_member(told, positive[i])) > 0);
    json_decref(told);
}

static void json_names_renderer_scene_and_speed(void **state)
{
    static const char *const who[] = {"naive", "octreel"};
    static const char *const positive[] = {"fps", "draw_ms", "encode_ms", "times_naive", "first_frame_ms", "mib"};
    (void)state;
    command_result run = film_without_browser("--json --folder .");
    const char *line = strtok(run.out, "\n");
    for (int i = 0; i < 2; i++, line = strtok(NULL, "\n"))
        assert_figures(line, who[i], positive, sizeof positive / sizeof positive[0]);
    assert_figures(line, "checked", (const char *const[]){"fps", "times_plain", "load_ms"}, 3);
    assert_null(strtok(NULL, "\n"));
    command_release(&run);
}

static void table_compares_every_figure_with_its_goal(void **state)
{
    (void)state;
    command_result run = film_without_browser("--folder .");
    const char *row = strstr(run.out, "octreel");
    assert_non_null(row);
    row = strstr(row, ">= 25x ");
    assert_non_null(row);
    assert_non_null(strstr(row, "<300 "));
    assert_non_null(strstr(row, "<200 "));
    command_release(&run);
}

/* Of M alone, with what that adds to a frame. */
static void queries_are_measured_with_and_without_answers(void **state)
{
    static const char *const who[] = {"asked", "answered"};
    (void)state;
    command_result run = run_bench("--browser no-such-browser --json --folder . --scene M --frames 6 --rounds 1");
    assert_int_equal(run.status, 0);
    strtok(run.out, "\n");
    strtok(NULL, "\n");
    strtok(NULL, "\n");
    for (int i = 0; i < 2; i++) {
        json_t *told = json_read(strtok(NULL, "\n"));
        assert_string_equal(json_string_value(json_member(told, "who")), who[i]);
        assert_true(json_number_value(json_member(told, "times_plain")) > 0);
        assert_int_equal(json_object_get(told, "judging") != NULL, i == 1);
        json_decref(told);
    }
    assert_null(strtok(NULL, "\n"));
    command_release(&run);
}

/* In a folder whose name an address would have to encode; the browser's files go with the frames. */
static void page_is_measured_beside_the_recorder(void **state)
{
    static const char *const positive[] = {"fps", "draw_ms", "times_naive", "first_frame_ms",
                                           "mib", "page_kb", "scrub_ms"};
    temp_folder *folder = *state;
    const place odd = place_in(folder, "a #100% of it");
    skip_without_browser();
    if (!page_can_play()) {
        print_message("octreel was built without WebAssembly: its pages do not play\n");
        skip();
    }
    assert_int_equal(mkdir(odd.path, 0777), 0);
    command_result run =
        run_script("%s --json " FILM_A_FEW "--folder %s", shell_quote(OCTREEL_BENCH).text, shell_quote(odd.path).text);
    assert_done(&run);
    strtok(run.out, "\n");
    strtok(NULL, "\n");
    strtok(NULL, "\n");
    const char *line = strtok(NULL, "\n");
    assert_figures(line, "page", positive, sizeof positive / sizeof positive[0]);
    json_t *told = json_read(line), *turning = json_object_get(told, "turning");
    assert_int_equal(json_array_size(turning), 2);
    for (size_t i = 0; i < 2; i++)
        assert_true(json_number_value(json_member(json_array_get(turning, i), "fps")) > 0);
    json_decref(told);
    assert_int_equal(rmdir(odd.path), 0);
    command_release(&run);
}

static void failing_browser_is_reported_with_its_last_words(void **state)
{
    temp_folder *folder = *state;
    const place browser = place_in(folder, "browser");
    FILE *file = fopen(browser.path, "w");
    assert_non_null(file);
    fputs("#!/bin/sh\necho no memory >&2\nexit 7\n", file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(chmod(browser.path, 0700), 0);
    if (!page_can_play())
        skip();
    command_result run = run_script("%s --page " FILM_A_FEW "--folder %s --browser ./%s",
                                    shell_quote(OCTREEL_BENCH).text, folder->name, browser.path);
    assert_int_equal(run.status, 0);
    assert_non_null(strstr(run.err, "ended with status 7 before the page had played; its last words: no memory\n"));
    command_release(&run);
}

static void bench_removes_its_frames(void **state)
{
    temp_folder *folder = *state;
    char arguments[128];
    snprintf(arguments, sizeof arguments, "--folder %s", folder->name);
    command_result run = film_without_browser(arguments);
    assert_int_equal(temp_folder_count(folder), 0);
    command_release(&run);
}

static void unknown_arguments_are_refused_with_a_sentence(void **state)
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
        cmocka_unit_test(json_names_renderer_scene_and_speed),
        cmocka_unit_test(table_compares_every_figure_with_its_goal),
        cmocka_unit_test(queries_are_measured_with_and_without_answers),
        cmocka_unit_test_setup_teardown(page_is_measured_beside_the_recorder, temp_folder_make, nested_folder_remove),
        cmocka_unit_test_setup_teardown(failing_browser_is_reported_with_its_last_words, temp_folder_make,
                                        temp_folder_remove),
        cmocka_unit_test_setup_teardown(bench_removes_its_frames, temp_folder_make, temp_folder_remove),
        cmocka_unit_test(unknown_arguments_are_refused_with_a_sentence),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
