/* SPDX-License-Identifier: MIT */
/* test_history.c - octreel accept keeps the digests that it replaces, and octreel diff calls a frame flaky if its
 * digest is one of them. */
#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "galleries.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Three states of three frames: in b, frames 1 and 2 differ from a; in c, frame 1 does again. */
typedef struct states {
    place a, b, c, baseline, history;
} states;

static int without_ci(void **state)
{
    unsetenv("CI");
    return temp_folder_make(state);
}

static states make_states(void **state)
{
    const states s = {gallery_make(*state, "a", "1.png 2.png 3.png"), gallery_make(*state, "b", "1.png 2.png 3.png"),
                      gallery_make(*state, "c", "1.png 2.png 3.png"), place_in(*state, "baseline.txt"),
                      place_in(*state, "baseline.txt.history")};
    gallery_write(place_below(s.b.path, "1.png").path, 0, 5);
    gallery_write(place_below(s.b.path, "2.png").path, 1, 5);
    gallery_write(place_below(s.c.path, "1.png").path, 0, 9);
    return s;
}

static void accept_state(const states *s, const place *frames, const char *day, const char *more)
{
    command_result result =
        run_octreel(NULL, "accept %s %s --reason why --date 2026-11-%s %s", s->baseline.path, frames->path, day, more);
    assert_done(&result);
    command_release(&result);
}

static command_result compare(const states *s, const place *frames, const char *more)
{
    return run_octreel(NULL, "diff %s %s %s", s->baseline.path, frames->path, more);
}

#define FLAKY "flaky: the digest was accepted earlier and has come back: "

static void digest_that_comes_back_is_flaky(void **state)
{
    const states s = make_states(state);
    accept_state(&s, &s.a, "02", "");
    assert_false(file_exists(s.history.path));
    accept_state(&s, &s.b, "09", "");
    command_result result = compare(&s, &s.a, "");
    assert_int_equal(result.status, 1);
    assert_contains(result.out,
                    "\n    " FLAKY "A (2026-11-02), B (2026-11-09), now A; accept it with --variant to allow "
                    "both\n    and 1 more frame with this finding: 2.png\n");
    command_release(&result);
    accept_state(&s, &s.a, "16", "");
    result = compare(&s, &s.b, "");
    assert_contains(result.out, FLAKY "A (2026-11-02), B (2026-11-09), A (2026-11-16), now B; ");
    command_release(&result);
    result = compare(&s, &s.b, "--json");
    assert_contains(result.out, "\"flaky\": \"" FLAKY "A (2026-11-02), B ");
    command_release(&result);
}

static void new_digest_and_missing_history_are_not_flaky(void **state)
{
    const states s = make_states(state);
    accept_state(&s, &s.a, "02", "");
    accept_state(&s, &s.b, "09", "");
    command_result result = compare(&s, &s.c, "");
    assert_contains(result.out, "1.png: pixels differ: ");
    assert_contains(result.out, "2.png: pixels differ: ");
    assert_contains(result.out, FLAKY);
    assert_true(strstr(result.out, FLAKY) > strstr(result.out, "2.png: ")); /* only the second frame */
    command_release(&result);
    assert_int_equal(unlink(s.history.path), 0);
    result = compare(&s, &s.a, "");
    assert_int_equal(result.status, 1);
    assert_null(strstr(result.out, "flaky"));
    command_release(&result);
}

static void variants_are_kept_in_the_baseline_and_not_in_the_history(void **state)
{
    const states s = make_states(state);
    accept_state(&s, &s.a, "02", "");
    accept_state(&s, &s.b, "09", "--variant");
    assert_false(file_exists(s.history.path));
    command_result result = compare(&s, &s.a, "");
    assert_int_equal(result.status, 0);
    command_release(&result);
    accept_state(&s, &s.c, "10", "1.png");
    result = compare(&s, &s.a, "");
    assert_contains(result.out, FLAKY "A (2026-11-02), B (2026-11-09), C (2026-11-10), now A; ");
    command_release(&result);
}

/* The sentence is in each report, because it is the cause. */
static void each_report_calls_the_frame_flaky(void **state)
{
    const states s = make_states(state);
    const place junit = place_in(*state, "junit.xml"), markdown = place_in(*state, "summary.md"),
                evidence = place_in(*state, "evidence");
    char more[3600];
    accept_state(&s, &s.a, "02", "");
    accept_state(&s, &s.b, "09", "");
    snprintf(more, sizeof more, "--junit %s --markdown %s -o %s --annotate", junit.path, markdown.path, evidence.path);
    command_result result = compare(&s, &s.a, more);
    const char *const files[] = {junit.path, markdown.path, place_below(evidence.path, "report.html").path};
    assert_contains(result.err, ". " FLAKY "A (2026-11-02), ");
    for (size_t i = 0; i < 3; i++) {
        char *text = file_read(files[i], NULL);
        assert_contains(text, "the digest was accepted earlier and has come back");
        free(text);
    }
    command_release(&result);
}

static void history_is_sorted_bounded_and_forgets_removed_frames(void **state)
{
    const states s = make_states(state);
    char day[3], *text;
    for (int i = 10; i < 24; i++) {
        snprintf(day, sizeof day, "%d", i);
        accept_state(&s, i % 2 ? &s.b : &s.c, day, "");
    }
    text = file_read(s.history.path, NULL);
    assert_memory_equal(text, "octreel-history 1\n2026-11-15 ", sizeof "octreel-history 1\n2026-11-15 " - 1);
    size_t lines = 0;
    for (const char *at = text; (at = strchr(at, '\n')); at++)
        lines++;
    assert_int_equal(lines, 1 + 2 * 8); /* the last eight digests of 1.png and 2.png */
    assert_true(strstr(text, " 2.png\n") > strstr(text, "2026-11-22 runs"));
    free(text);
    assert_int_equal(unlink(place_below(s.c.path, "1.png").path), 0);
    accept_state(&s, &s.c, "25", "");
    text = file_read(s.history.path, NULL);
    assert_null(strstr(text, " 1.png"));
    free(text);
}

/* A union merge by git repeats lines and does not sort them. */
static void merged_history_is_read(void **state)
{
    const states s = make_states(state);
    accept_state(&s, &s.a, "02", "");
    accept_state(&s, &s.b, "09", "");
    char *text = file_read(s.history.path, NULL), twice[2048];
    const char *lines = strchr(text, '\n') + 1;
    snprintf(twice, sizeof twice, "octreel-history 1\n2026-11-04 runs 00000000000000ff 9.png\n%s%s", lines, lines);
    file_write_text(s.history.path, twice);
    command_result result = compare(&s, &s.a, "");
    assert_contains(result.out, FLAKY "A (2026-11-02), B (2026-11-09), now A; ");
    command_release(&result);
    free(text);
}

static void invalid_line_is_refused(void **state)
{
    static const struct {
        const char *text, *part;
    } rows[] = {
        {"octreel-history 2\n", ".history:1: expected \"octreel-history 1\""},
        {"octreel-history 1\n<<<<<<< ours\n", ".history:2: expected a date"},
        {"octreel-history 1\n2026-02-30 runs 00000000000000ff 1.png\n", ".history:2: expected a date"},
        {"octreel-history 1\n2026-11-02 walks 00000000000000ff 1.png\n", ".history:2: expected a date"},
        {"octreel-history 1\n2026-11-02 runs 0xff 1.png\n", ".history:2: expected a date"},
        {"octreel-history 1\n2026-11-02 runs 00000000000000ff \n", ".history:2: expected a date"},
        {"octreel-history 1\n\n", ".history:2: expected a date"},
    };
    const states s = make_states(state);
    accept_state(&s, &s.a, "02", "");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        file_write_text(s.history.path, rows[i].text);
        command_result result = compare(&s, &s.b, "");
        assert_trouble(&result, rows[i].part);
        result = run_octreel(NULL, "accept %s %s --reason why", s.baseline.path, s.b.path);
        assert_trouble(&result, rows[i].part);
    }
    command_result result = compare(&s, &s.a, "");
    assert_trouble(&result, "expected a date"); /* even where nothing differs: the file would fail later */
}

#define HISTORY(test) cmocka_unit_test_setup_teardown(test, without_ci, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        HISTORY(digest_that_comes_back_is_flaky),
        HISTORY(new_digest_and_missing_history_are_not_flaky),
        HISTORY(variants_are_kept_in_the_baseline_and_not_in_the_history),
        HISTORY(each_report_calls_the_frame_flaky),
        HISTORY(history_is_sorted_bounded_and_forgets_removed_frames),
        HISTORY(merged_history_is_read),
        HISTORY(invalid_line_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
