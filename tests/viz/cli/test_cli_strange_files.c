/* SPDX-License-Identifier: MIT */
/* test_cli_strange_files.c - pipes and links with the names of recording files: no command waits for a pipe or writes
 * through a link. */
#include <string.h>

#include <stdio.h>

#include "commands.h"
#include "fixture.h"
#include "galleries.h"

static const char *const names[] = {
    "ticks.jsonl",       "ticks.jsonl.part",   "ticks_2_5.jsonl",  "session.json",          "session.json.part",
    "session.json.live", "index.html",         "index.html.part",  "recording.json",        "recording.json.part",
    "renderer.json",     "renderer.json.part", "frame_000003.png", "frame_000003.png.part",
};

/* Run each command on the recording `film`, after a shell line that puts a strange file at "$1". A command may succeed
 * or refuse, but not take longer than the limit of timeout(1), which then ends with status 124. */
static void assert_nothing_leaves(const temp_folder *folder, const char *make, const char *name)
{
    static const char *const commands[] = {"record --resume -o edited", "join edited", "film edited -o film.png"};
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) {
        command_result result = run_script(
            "cd %s && rm -rf edited && cp -r %s edited && echo kept >kept && set -- edited/%s && rm -f \"$1\" && %s && "
            "{ timeout 60 %s %s >said 2>&1 || [ $? -le 2 ]; } && echo kept | cmp - kept && [ ! -e new ]",
            folder->name, strncmp(commands[i], "join", 4) == 0 ? "chunks" : "film", name, make, octreel_program(),
            commands[i]);
        if (result.status != 0)
            fail_msg("%s at %s, then %s: %d %s%s", make, name, commands[i], result.status, result.out, result.err);
        command_release(&result);
    }
}

static int film(void **state)
{
    temp_folder_make(state);
    const temp_folder *folder = *state;
    command_result result =
        run_script("cd %s && record() { %s record --keys wdna --size 64x36 --jobs 1 --quiet \"$@\"; } && "
                   "record -o film && record --ticks 0:2 -o chunks && record --ticks 2: -o chunks",
                   folder->name, octreel_program());
    assert_int_equal(result.status, 0);
    command_release(&result);
    return 0;
}

static int remove_all(void **state)
{
    const temp_folder *folder = *state;
    command_result result = run_script("rm -rf %s/film %s/chunks %s/edited %s/kept %s/said", folder->name, folder->name,
                                       folder->name, folder->name, folder->name);
    command_release(&result);
    return temp_folder_remove(state);
}

static void no_command_waits_for_a_pipe_in_a_folder(void **state)
{
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        assert_nothing_leaves(*state, "mkfifo \"$1\"", names[i]);
}

static void no_command_writes_through_a_link(void **state)
{
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        assert_nothing_leaves(*state, "ln -s ../kept \"$1\"", names[i]);
        assert_nothing_leaves(*state, "ln -s ../new \"$1\"", names[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_command_waits_for_a_pipe_in_a_folder),
        cmocka_unit_test(no_command_writes_through_a_link),
    };
    return cmocka_run_group_tests(tests, film, remove_all);
}
