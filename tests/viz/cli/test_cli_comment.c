/* SPDX-License-Identifier: MIT */
/* test_cli_comment.c - octreel diff --comment writes the comment of a pull request and the pictures that it shows. */
#include "commands.h"
#include "files.h"
#include "file.h"
#include "fixture.h"
#include "galleries.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int without_ci(void **state)
{
    unsetenv("CI");
    return temp_folder_make(state);
}

/* A folder of references, one of new frames, and where the comment is written. */
typedef struct sides {
    const temp_folder *in;
    place golden, frames, comment;
} sides;

static sides make_sides(void **state, const char *names)
{
    return (sides){*state, gallery_make(*state, "golden", names), gallery_make(*state, "frames", names),
                   place_in(*state, "comment")};
}

static void spoil(const sides *s, const char *name, uint64_t seed, int pixels)
{
    gallery_write(place_below(s->frames.path, name).path, seed, pixels);
}

/* Compare in the folder of the test, so that the paths are short. Returns comment.md; the caller frees it. */
static char *comment_on(const sides *s, const char *reference, int status)
{
    command_result result = run_script("cd %s && rm -rf comment && %s diff %s frames -o evidence --comment comment",
                                       s->in->name, octreel_program(), reference);
    assert_int_equal(result.status, status);
    assert_string_equal(result.err, "");
    command_release(&result);
    return file_read(place_below(s->comment.path, "comment.md").path, NULL);
}

static void finding_has_its_sentence_pictures_and_accept_line(void **state)
{
    static const char expected[] = "### octreel diff: different: 3 of 4 frames, 1 with the same bytes\n\n"
                                   "<code>frames</code> against <code>golden</code>, compared exactly.\n\n"
                                   "#### 1. <code>1.png</code> and 1 more: 2.png\n\n"
                                   "5 of 384 pixels differ; ",
                      pictures[] = "\n\n<!-- pictures -->\n| expected | actual | difference |\n|---|---|---|\n"
                                   "| ![expected](./1.expected.png) | ![actual](./1.actual.png) | "
                                   "![difference](./1.difference.png) |\n<!-- /pictures -->\n\n"
                                   "```sh\noctreel accept golden frames 1.png 2.png\n```\n",
                      rest[] = "#### 2. <code>3.png</code>\n\n"
                               "a reference without a frame\n\n"
                               "<!-- pictures -->\n| expected |\n|---|\n| ![expected](./2.expected.png) |\n"
                               "<!-- /pictures -->\n\n"
                               "```sh\noctreel accept golden frames 3.png\n```\n"
                               "\nTo accept everything:\n```sh\noctreel accept golden frames\n```\n";
    const sides s = make_sides(state, "1.png 2.png 3.png 4.png");
    gallery_write(place_below(s.golden.path, "2.png").path, 0, 0);
    spoil(&s, "1.png", 0, 5);
    spoil(&s, "2.png", 0, 5);
    assert_int_equal(unlink(place_below(s.frames.path, "3.png").path), 0);
    char *text = comment_on(&s, "golden", 1);
    assert_memory_equal(text, expected, sizeof expected - 1);
    assert_contains(text, pictures);
    assert_contains(text, rest);
    free(text);
    assert_true(
        have_same_bytes(place_below(s.comment.path, "1.actual.png").path, place_below(s.frames.path, "1.png").path));
    assert_true(
        have_same_bytes(place_below(s.comment.path, "1.expected.png").path, place_below(s.golden.path, "1.png").path));
    assert_true(file_exists(place_below(s.comment.path, "1.difference.png").path));
    assert_false(file_exists(place_below(s.comment.path, "2.actual.png").path));
}

static void comment_of_equal_frames_is_the_verdict(void **state)
{
    const sides s = make_sides(state, "1.png");
    char *text = comment_on(&s, "golden", 0);
    assert_string_equal(text, "### octreel diff: same: 1 frame, 1 with the same bytes\n\n<code>frames</code> against "
                              "<code>golden</code>, compared exactly.\n\n");
    free(text);
}

/* Names cannot end the block of code, start an HTML comment, notify a person, or run in a shell. */
static void any_name_is_quoted_or_left_out(void **state)
{
    static const struct {
        const char *name, *accept;
    } rows[] = {
        {"two words.png", "frames 'two words.png'\n"},
        {"$(touch owned).png", "frames '$(touch owned).png'\n"},
        {"it's.png", "frames 'it'\\''s.png'\n"},
        {"```.png", "frames '```.png'\n"},
        {"<!-- _pictures -->@octocat#1.png", "frames '<!-- _pictures -->@octocat#1.png'\n"},
        {"--force.png", NULL},
        {"a\nb.png", NULL},
        {"a\n```.png", NULL},
    };
    const sides s = make_sides(state, "");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *name = rows[i].name;
        gallery_write(place_below(s.golden.path, name).path, 1, 0);
        spoil(&s, name, 1, 3);
        char *text = comment_on(&s, "golden", 1);
        const char *accept = strstr(text, "```sh\n");
        if (rows[i].accept)
            assert_contains(text, rows[i].accept);
        else if (accept)
            fail_msg("%s", text);
        assert_null(strstr(text, "<code><!--"));
        assert_null(strstr(text, "<code>@"));
        assert_int_equal(unlink(place_below(s.golden.path, name).path), 0);
        assert_int_equal(unlink(place_below(s.frames.path, name).path), 0);
        free(text);
    }
}

static void many_frames_are_accepted_from_the_page(void **state)
{
    char names[400] = "";
    for (int i = 10; i < 31; i++)
        sprintf(names + strlen(names), "%d.png ", i);
    const sides s = make_sides(state, names);
    for (int i = 10; i < 31; i++) {
        char name[16];
        snprintf(name, sizeof name, "%d.png", i);
        gallery_write(place_below(s.golden.path, name).path, 0, 0);
        spoil(&s, name, 0, 5);
    }
    char *text = comment_on(&s, "golden", 1);
    assert_contains(text,
                    "```sh\noctreel accept golden frames --from accept.txt\n```\nSelect this finding in report.html");
    free(text);
}

static void baseline_is_accepted_with_a_reason(void **state)
{
    const sides s = make_sides(state, "1.png 2.png");
    command_result result =
        run_script("cd %s && %s accept b.txt golden --reason first --store store", s.in->name, octreel_program());
    assert_done(&result);
    command_release(&result);
    spoil(&s, "1.png", 0, 5);
    char *text = comment_on(&s, "b.txt --store store", 1);
    assert_contains(text, "```sh\noctreel accept b.txt frames 1.png --reason \"...\"\n```\n");
    assert_contains(text, "](./1.difference.png)");
    free(text);
}

static void findings_that_do_not_fit_are_counted(void **state)
{
    const sides s = make_sides(state, "");
    char name[256];
    for (int i = 0; i < 12; i++) {
        snprintf(name, sizeof name, "%d.png", i);
        gallery_write(place_below(s.golden.path, name).path, (uint64_t)i, 0);
        spoil(&s, name, (uint64_t)i, i + 1);
    }
    char *text = comment_on(&s, "golden", 1);
    assert_contains(text, "#### 10. <code>");
    assert_null(strstr(text, "#### 11. "));
    assert_contains(text, "\nand 2 more findings in report.html\n");
    free(text);
}

/* 12 findings of 20 frames each, whose names become five times as long when they are escaped. */
static void comment_is_never_longer_than_github_takes(void **state)
{
    const sides s = make_sides(state, "");
    char name[256];
    for (int i = 0; i < 12 * 20; i++) {
        memset(name, '_', sizeof name);
        snprintf(name + 200, sizeof name - 200, "-%03d.png", i);
        memset(name, '~', 200);
        gallery_write(place_below(s.golden.path, name).path, (uint64_t)(i / 20), 0);
        spoil(&s, name, (uint64_t)(i / 20), i / 20 + 1);
    }
    char *text = comment_on(&s, "golden", 1);
    assert_true(strlen(text) > 20000 && strlen(text) < 65000);
    assert_contains(text, " more findings in report.html\n");
    free(text);
}

static void comment_needs_evidence_and_an_empty_folder(void **state)
{
    const sides s = make_sides(state, "1.png");
    command_result result = run_octreel(NULL, "diff %s %s --comment %s", s.golden.path, s.frames.path, s.comment.path);
    assert_trouble(&result, "--comment shows pictures of the evidence: add --output DIR");
    result = run_octreel(NULL, "diff %s %s -o %s --comment %s", s.golden.path, s.frames.path,
                         place_in(*state, "evidence").path, s.frames.path);
    assert_trouble(&result, "contains 1.png; choose a new or empty folder");
}

#define COMMENT(test) cmocka_unit_test_setup_teardown(test, without_ci, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        COMMENT(finding_has_its_sentence_pictures_and_accept_line),
        COMMENT(comment_of_equal_frames_is_the_verdict),
        COMMENT(any_name_is_quoted_or_left_out),
        COMMENT(many_frames_are_accepted_from_the_page),
        COMMENT(baseline_is_accepted_with_a_reason),
        COMMENT(findings_that_do_not_fit_are_counted),
        COMMENT(comment_is_never_longer_than_github_takes),
        COMMENT(comment_needs_evidence_and_an_empty_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
