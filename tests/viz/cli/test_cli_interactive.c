/* SPDX-License-Identifier: MIT */
/* test_cli_interactive.c - octreel accept --interactive accepts the findings that a person answers with y or a. */
#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "galleries.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int without_ci(void **state)
{
    unsetenv("CI");
    return temp_folder_make(state);
}

/* Four references, and new frames of which 1.png and 2.png differ in the same way, 3.png in another one, and 4.png is
 * missing: three findings. */
typedef struct change {
    place golden, frames, temp;
} change;

static change make_change(void **state)
{
    const change c = {gallery_make(*state, "golden", "1.png 2.png 3.png 4.png"),
                      gallery_make(*state, "frames", "1.png 2.png 3.png"), place_in(*state, "temp")};
    gallery_write(place_below(c.golden.path, "2.png").path, 0, 0);
    for (int i = 0; i < 3; i++)
        gallery_write(place_below(c.frames.path, (char[]){(char)('1' + i), '.', 'p', 'n', 'g', 0}).path, i < 2 ? 0 : 2,
                      i < 2 ? 5 : 9);
    assert_int_equal(mkdir(c.temp.path, 0700), 0);
    return c;
}

/* Accept with these answers as standard input. */
static command_result answer(void **state, const change *c, const char *answers, const char *more)
{
    const place input = place_in(*state, "answers");
    char temp[1200];
    snprintf(temp, sizeof temp, "TMPDIR=%s", c->temp.path);
    file_write_text(input.path, answers);
    const command_setting setting = {.environment = {temp}, .input = input.path};
    return run_octreel(&setting, "accept %s %s --interactive %s", c->golden.path, c->frames.path, more);
}

static bool is_accepted(const change *c, const char *name)
{
    const place a = place_below(c->golden.path, name), b = place_below(c->frames.path, name);
    if (!file_exists(a.path) || !file_exists(b.path))
        return file_exists(a.path) == file_exists(b.path);
    size_t sizes[2];
    char *bytes[2] = {file_read(a.path, &sizes[0]), file_read(b.path, &sizes[1])};
    const bool same = sizes[0] == sizes[1] && memcmp(bytes[0], bytes[1], sizes[0]) == 0;
    free(bytes[0]);
    free(bytes[1]);
    return same;
}

/* One letter for each frame: y if it is accepted. */
static void assert_accepted(const change *c, const char *expected)
{
    for (int i = 0; i < 4; i++) {
        const char name[] = {(char)('1' + i), '.', 'p', 'n', 'g', 0};
        if (is_accepted(c, name) != (expected[i] == 'y'))
            fail_msg("%s: expected %c", name, expected[i]);
    }
}

static void answers_choose_the_findings(void **state)
{
    static const struct {
        const char *answers, *accepted, *summary;
    } rows[] = {
        {"y\nn\ny\n", "yyny", "4 before, 3 after: 2 changed, 0 new, 1 removed"},
        {"n\nyes\nn\n", "nnyn", "4 before, 4 after: 1 changed, 0 new, 0 removed"},
        {"n\na\n", "nnyy", "4 before, 3 after: 1 changed, 0 new, 1 removed"},
        {"y\nq\n", "yynn", "4 before, 4 after: 2 changed, 0 new, 0 removed"},
        {"y\n", "yynn", "4 before, 4 after: 2 changed, 0 new, 0 removed"},
        {"", "nnnn", "4 before, 4 after: 0 changed, 0 new, 0 removed"},
        {"\nwhat?\nq\n", "nnnn", "4 before, 4 after: 0 changed, 0 new, 0 removed"},
        {"n\nn\nn\ny\n", "nnnn", "4 before, 4 after: 0 changed, 0 new, 0 removed"},
        {"y", "yynn", "4 before, 4 after: 2 changed, 0 new, 0 removed"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const change c = make_change(state);
        command_result result = answer(state, &c, rows[i].answers, "");
        assert_done(&result);
        assert_contains(result.out, rows[i].summary);
        assert_accepted(&c, rows[i].accepted);
        command_release(&result);
        result = run_script("rm -rf %s/*", ((temp_folder *)*state)->name);
        assert_done(&result);
        command_release(&result);
    }
}

static void question_shows_the_sentence_and_the_pictures(void **state)
{
    const change c = make_change(state);
    char part[3200];
    command_result result = answer(state, &c, "n\n?\n", "");
    assert_done(&result);
    assert_contains(result.out, "\nfinding 1 of 3:\n  1.png: 5 of 384 pixels differ; ");
    assert_contains(result.out, "\n    and 1 more frame with this finding: 2.png\n");
    snprintf(part, sizeof part,
             "\n    expected    %s/1.png\n    actual      %s/1.png\n    difference  %s/octreel-accept-", c.golden.path,
             c.frames.path, c.temp.path);
    assert_contains(result.out, part);
    assert_contains(result.out, "/difference.png\naccept? y, n, a, q or ? for help: \nfinding 2 of 3:\n  3.png: ");
    assert_contains(result.out, "  q  quit; the findings that were accepted stay accepted\naccept? ");
    command_release(&result);
    assert_int_equal(rmdir(c.temp.path), 0); /* the difference picture and its folder are removed */
}

/* The picture exists while the question is asked: a program that answers looks at it first. */
static void difference_picture_exists_during_the_question(void **state)
{
    make_change(state);
    command_result result = run_script(
        "cd %s && mkfifo in && (TMPDIR=temp %s accept golden frames --interactive <in >out &) && exec 3>in && "
        "until grep -qs accept? out; do :; done && cp temp/octreel-accept-*/difference.png . && echo q >&3 && "
        "exec 3>&- && until grep -q before out; do :; done",
        ((temp_folder *)*state)->name, octreel_program());
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s", place_in(*state, "difference.png").path,
                         place_in(*state, "difference.png").path);
    assert_int_equal(result.status, 0);
    command_release(&result);
}

static void unreadable_frame_is_reported_and_not_asked_about(void **state)
{
    const change c = make_change(state);
    file_write_text(place_below(c.frames.path, "3.png").path, "\x89PNG, or so");
    command_result result = answer(state, &c, "a\n", "");
    assert_done(&result);
    assert_contains(result.out, "finding 1 of 2:\n");
    assert_contains(result.out, "\n  3.png: cannot be read: ");
    assert_accepted(&c, "yyny");
    command_release(&result);
}

static void baseline_gets_the_digests_of_chosen_findings(void **state)
{
    const change c = make_change(state);
    const place baseline = place_in(*state, "baseline.txt"), input = place_in(*state, "answers");
    const command_setting setting = {.input = input.path};
    command_result result = run_octreel(NULL, "accept %s %s --reason first", baseline.path, c.golden.path);
    assert_done(&result);
    command_release(&result);
    file_write_text(input.path, "y\nn\nn\nn\n");
    result = run_octreel(&setting, "accept %s %s --interactive", baseline.path, c.frames.path);
    assert_trouble(&result, "accepting into a baseline needs a reason");
    result = run_octreel(&setting, "accept %s %s --interactive --reason second", baseline.path, c.frames.path);
    assert_done(&result);
    assert_contains(result.out, "1 changed, 0 new, 0 removed");
    command_release(&result);
}

static void impossible_questions_are_refused(void **state)
{
    static const struct {
        const char *more, *part;
    } rows[] = {
        {"1.png", "give it neither --from nor names of frames"},
        {"--from list", "give it neither --from nor names of frames"},
        {"--json", "leave out one of them"},
    };
    const change c = make_change(state);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        command_result result = answer(state, &c, "a\n", rows[i].more);
        assert_trouble(&result, rows[i].part);
    }
    command_result result = run_octreel(NULL, "accept %s - --interactive", c.golden.path);
    assert_trouble(&result, "reads the answers from standard input");
    const command_setting ci = {.environment = {"CI=true"}};
    result = run_octreel(&ci, "accept %s %s --interactive", c.golden.path, c.frames.path);
    assert_trouble(&result, "CI is set");
    assert_accepted(&c, "nnnn");
}

#define QUESTION(test) cmocka_unit_test_setup_teardown(test, without_ci, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        QUESTION(answers_choose_the_findings),
        QUESTION(question_shows_the_sentence_and_the_pictures),
        QUESTION(difference_picture_exists_during_the_question),
        QUESTION(unreadable_frame_is_reported_and_not_asked_about),
        QUESTION(baseline_gets_the_digests_of_chosen_findings),
        QUESTION(impossible_questions_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
