/* SPDX-License-Identifier: MIT */
/* test_cli_max_ticks.c - commands refuse a session with more ticks than --max-ticks allows, before they play it. */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "edits.h"
#include "files.h"
#include "fixture.h"
#include "page.h"
#include "recordings.h"

#define HEADER "{\"octreel\":\"session\",\"version\":2,\"points\":[[1,2,3,1]]"
#define ANSWER "{\"tick\":1,\"queries\":[{\"nearest\":[1,2,3],\"answer\":[1]}]}\n"

/* A line of shell for each command that plays a session: %1$s is the program, %2$s the option, %3$s a folder with
 * s.json and the recording "film" of it. */
static const char *const lines[] = {
    "%1$s record %3$s/s.json --no-frames %2$s -o %3$s/new",
    "%1$s record - --no-frames %2$s -o %3$s/new <%3$s/s.json",
    "%1$s play %3$s/s.json %2$s -o %3$s/new",
    "%1$s audit %3$s/s.json %2$s",
    "%1$s verify %3$s/film %2$s",
    "%1$s pick %3$s/film/frame_000001.png 32 18 --json %2$s",
};

enum { LINES = sizeof lines / sizeof lines[0] };

static bool is_skipped(size_t line)
{
    return strstr(lines[line], " play ") && !page_can_play();
}

static place make_folder(void **state)
{
    const place folder = place_in(*state, "given");
    command_result result =
        run_script("mkdir %1$s && printf '%%s' '" HEADER ",\"ticks\":20}" ANSWER "' >%1$s/s.json && "
                   "%2$s record %1$s/s.json --size 64x36 --quiet -o %1$s/film",
                   folder.path, octreel_program());
    assert_done(&result);
    command_release(&result);
    return folder;
}

static command_result run_line(size_t line, const char *option, const char *folder)
{
    return run_script(lines[line], octreel_program(), option, folder);
}

static void a_billion_ticks_are_refused_at_once(void **state)
{
    const place folder = make_folder(state);
    edit_file(folder.path, "s.json", "\"ticks\":20", "\"ticks\":1000000000");
    edit_file(place_below(folder.path, "film").path, "session.json", "\"ticks\": 20", "\"ticks\": 1000000000");
    for (size_t i = 0; i < LINES; i++) {
        if (is_skipped(i))
            continue;
        command_result result = run_line(i, "", folder.path);
        assert_trouble(&result, "the session has 1000000000 ticks, more than the limit of 10000000; --max-ticks "
                                "1000000000 plays it anyway");
        assert_false(file_exists(place_below(folder.path, "new").path));
    }
}

static void max_ticks_sets_the_limit(void **state)
{
    const place folder = make_folder(state);
    for (size_t i = 0; i < LINES; i++) {
        if (is_skipped(i))
            continue;
        command_result result = run_line(i, "--max-ticks 19", folder.path);
        assert_trouble(&result, "the session has 20 ticks, more than the limit of 19; --max-ticks 20");
        result = run_line(i, "--max-ticks 20", folder.path);
        assert_done(&result);
        command_release(&result);
        result = run_script("rm -rf %s/new", folder.path);
        command_release(&result);
    }
}

/* The pixels are compared in any case. */
static void diff_explains_nothing_beyond_the_limit(void **state)
{
    const place folder = make_folder(state);
    for (int most = 19; most <= 20; most++) {
        command_result result =
            run_script("cd %1$s && %2$s record s.json --keys w --size 64x36 --quiet --replace -o other "
                       "&& %2$s diff film other --max-ticks %3$d",
                       folder.path, octreel_program(), most);
        assert_int_equal(result.status, most == 19 ? 2 : 1);
        assert_non_null(strstr(result.out, " pixels differ"));
        if (most == 19)
            assert_non_null(strstr(result.err,
                                   "the session has 20 ticks, more than the limit of 19; --max-ticks 20 plays "
                                   "it anyway; --causes 0 skips the explanation\n"));
        else
            assert_string_equal(result.err, "");
        command_release(&result);
    }
}

/* The number of ticks of a stream is not known before they arrive. */
static void stream_ends_at_the_limit(void **state)
{
    const place folder = place_in(*state, "film");
    command_result result = run_script("printf '%%s' '" HEADER "}" ANSWER "{\"tick\":1000000,\"edits\":[]}' | "
                                       "%s record - --no-frames --max-ticks 999999 -o %s",
                                       octreel_program(), folder.path);
    assert_trouble(&result, "the session has 1000000 ticks, more than the limit of 999999; --max-ticks 1000000 plays "
                            "it anyway; ");
    assert_int_equal(for_each_line(folder.path, NULL, NULL), 2);
    result = run_script("printf '%%s' '" HEADER ",\"keys\":\"wdwd\"}' | %s record - --max-ticks 3 -o %s.2",
                        octreel_program(), folder.path);
    assert_trouble(&result, "the session has 4 ticks, more than the limit of 3; ");
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(a_billion_ticks_are_refused_at_once),
        IN_FOLDER(max_ticks_sets_the_limit),
        IN_FOLDER(diff_explains_nothing_beyond_the_limit),
        IN_FOLDER(stream_ends_at_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
