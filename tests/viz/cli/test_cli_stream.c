/* SPDX-License-Identifier: MIT */
/* test_cli_stream.c - octreel record - films a session while it is written, to the same bytes as from a file; the ticks
 * before an interruption are a whole recording. */
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "background.h"
#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "recordings.h"

#define HEADER "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[1,2,3,1]]}\n"
#define MOVE(tick) "{\"tick\":" #tick ",\"edits\":[{\"move\":{\"id\":1,\"position\":[" #tick ",0,0]}}]}\n"
#define MANY                                                                                                           \
    "{\"octreel\":\"session\",\"version\":2,%s \"points\":{\"sample\":\"uniform\",\"count\":20,\"seed\":1},\n"         \
    "\"velocities\":{\"speed\":9,\"seed\":2},\"queries\":[{\"knearest\":2,\"at\":\"player\"}],\"shapes\":[{\"point\":" \
    "[1,2,3]}]}\n"
#define TICKS                                                                                                          \
    "{\"tick\":3,\"edits\":[{\"insert\":{\"id\":99,\"position\":[1,2,3],\"velocity\":[9,9,9]}},{\"remove\":7}]}{"      \
    "\"tick"                                                                                                           \
    "\":5}\n{\"tick\":6,\"gap\":\"lost\"}"

/* ---- The same as its file ----------------------------------------------------------------------------------- */

static void assert_same_recording(void **state, const char *text, const char *options)
{
    static int count;
    char names[3][16];
    for (int i = 0; i < 3; i++)
        snprintf(names[i], sizeof names[i], "%c%d", "sab"[i], count);
    count++;
    const place file = place_in(*state, names[0]), a = place_in(*state, names[1]), b = place_in(*state, names[2]);
    file_write_text(file.path, text);
    command_result result =
        run_script("%1$s record %2$s --size 32x18 %3$s -o %4$s && cat %2$s | %1$s record - --size 32x18 %3$s -o %5$s",
                   octreel_program(), file.path, options, a.path, b.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(a.path, b.path, NULL);
}

/* The number of ticks comes from the keys, from the header, or from the last object. */
static void stream_is_recorded_as_the_same_session_file(void **state)
{
    static const char *const ends[] = {"",
                                       "\"keys\":\"wdsaenwd\",",
                                       "\"keys\":\"wd\",",
                                       "\"keys\":\"wdqs\",",
                                       "\"ticks\":4,",
                                       "\"ticks\":9,",
                                       "\"ticks\":4,\"keys\":\"wdwdwdwd\","};
    static const char *const firsts[] = {"", "{\"tick\":0,\"queries\":[{\"radius\":9,\"at\":[0,0,0],\"answer\":[]}]}\n",
                                         "{\"tick\":0,\"gap\":\"not yet\"}\n"};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        char text[1024];
        const int used = snprintf(text, sizeof text, MANY, ends[i]);
        snprintf(text + used, sizeof text - (size_t)used, "%s%s", firsts[i % 3], i == 2 ? "" : TICKS);
        assert_same_recording(state, text, "");
    }
}

static void options_work_as_for_a_file(void **state)
{
    char text[1024];
    snprintf(text, sizeof text, MANY TICKS, "");
    assert_same_recording(state, text, "--every 2 --camera orbit --diagram beside");
    assert_same_recording(state, text, "--no-frames");
    assert_same_recording(state, text, "--keys wwddwwdd --layers all --jobs 1");
    assert_same_recording(state, text, "--replace");
}

/* The panel and the legend must not show anything of later ticks. */
static void frames_do_not_depend_on_later_ticks(void **state)
{
    static const char later[] =
        "{\"tick\":2,\"queries\":[{\"radius\":9,\"at\":[0,0,0]}]}{\"tick\":3,\"queries\":[{\"range\":{\"min\":[0,0,0],"
        "\"max\":[9,9,9.25]}},{\"radius\":9.125,\"at\":\"player\",\"answer\":[7]}],\"edits\":[{\"remove\":4}]}"
        "{\"tick\":4,\"shapes\":[{\"label\":\"late\",\"at\":[1,2,3.5]}]}"
        "{\"tick\":5,\"foreign_nodes\":[{\"id\":5,\"box\":{\"min\":[1,1,1],\"max\":[5,5,5]},\"kind\":\"leaf\"}]}";
    char text[2048];
    snprintf(text, sizeof text, MANY "%s", "\"keys\":\"wdwds\",", later);
    assert_same_recording(state, text, "--size 640x720");
}

static void options_that_need_a_whole_session_are_refused(void **state)
{
    static const char *const refused[][2] = {
        {"--resume", "--resume uses the session stored in DIR"},
        {"--ticks 1:", "--ticks needs a whole session"},
        {"--jobs 2", "--jobs needs a whole session"},
        {"--keys x", "key 1, 'x', is not one of"},
        {"-", "record: unexpected argument"},
    };
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        const place folder = place_in(*state, "film");
        command_result result =
            run_script("printf '%s' | %s record - %s -o %s", HEADER, octreel_program(), refused[i][0], folder.path);
        assert_trouble(&result, refused[i][1]);
        assert_false(file_exists(folder.path));
    }
}

/* ---- Broken off --------------------------------------------------------------------------------------------- */

/* The test fails unless a text is recorded up to its first `good` characters, with a sentence about the rest. */
static void assert_broken(void **state, const char *text, size_t good, const char *sentence)
{
    static int count;
    char names[3][16];
    for (int i = 0; i < 3; i++)
        snprintf(names[i], sizeof names[i], "%c%d", "xyz"[i], count);
    count++;
    const place file = place_in(*state, names[0]), a = place_in(*state, names[1]), b = place_in(*state, names[2]);
    file_write_text(file.path, text);
    command_result result = run_script("%s record - --size 32x18 -o %s <%s", octreel_program(), a.path, file.path);
    assert_trouble(&result, sentence);
    file_write(file.path, text, good);
    if (good == 0) {
        assert_false(file_exists(a.path));
        return;
    }
    result = run_octreel(NULL, "record --size 32x18 %s -o %s", file.path, b.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(a.path, b.path, NULL);
}

#define BROKEN(good, bad, sentence) assert_broken(state, good bad, sizeof(good) - 1, sentence)

static void ticks_before_malformed_text_are_a_whole_recording(void **state)
{
    BROKEN("", "", "standard input:1: holds no session");
    BROKEN("", "\nhello\n" MOVE(1), "standard input:2: '{' expected near 'hello'");
    BROKEN("", "{\"octreel\":\"session\",", "standard input:1: the text ends inside the object");
    BROKEN(HEADER, "{\"tick\":0,\"edits\":[]}\n", "standard input:2: edits: edits are not allowed in tick 0");
    BROKEN(HEADER MOVE(1), "{\"tick\":2,\"ed", "standard input:3: the text ends inside the object that begins");
    BROKEN(HEADER MOVE(1), "segmentation fault\n", "standard input:3: '{' expected near 'segmentation'");
    BROKEN(HEADER MOVE(1), "{\"tick\":2\n" MOVE(3), "standard input:4: '}' expected near '{'");
    BROKEN(HEADER MOVE(1), "{\"tick\":2,\"edits\":[{\"move\":{\"id\":1,\"position\":[1,2]}}]}\n" MOVE(3),
           "standard input:3: edits[0].move.position: expected three numbers");
    BROKEN(HEADER MOVE(1), MOVE(1), "standard input:3: tick: tick 1 follows tick 1; ticks must ascend");
    BROKEN(HEADER MOVE(2) MOVE(4), "{\"tick\":9,\"queries\":[{\"nearest\":[0,0,0],\"answer\":[1,\"x\"]}]}\n",
           "standard input:4: queries[0].answer[1]: expected a whole number");
}

/* Announced ticks that never came are not recorded. Frames show the keys of the session. */
static void truncated_session_ends_with_its_last_tick(void **state)
{
    const place folder = place_in(*state, "film");
    command_result result = run_script("printf '{\"octreel\":\"session\",\"version\":2,\"ticks\":50,\"keys\":"
                                       "\"wdwdwd\"}\\n{\"tick\":2}\\n{\"tick\":x}' | %s record - --size 640x360 -o %s",
                                       octreel_program(), folder.path);
    assert_trouble(&result, "standard input:3: invalid token near 'x'; ");
    char *session = file_read(place_below(folder.path, "session.json").path, NULL);
    assert_non_null(strstr(session, "\"keys\": \"wdwdwd\",\n"));
    assert_non_null(strstr(session, "\"ticks\": 2,\n"));
    assert_non_null(strstr(session, "\"unplayed\": 4"));
    free(session);
    result = run_octreel(NULL, "verify %s", folder.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "identical: 3 ticks, 3 frames"));
    command_release(&result);
}

static void ticks_before_a_crash_are_a_whole_recording(void **state)
{
    const place folder = place_in(*state, "film");
    command_result result = run_script(
        "sh -c 'printf \"$0\"; kill -9 $$' '" HEADER MOVE(1) "' | %s record - --size 16x16 -o %s && %s verify %s",
        octreel_program(), folder.path, octreel_program(), folder.path);
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.out, "identical: 2 ticks, 2 frames"));
    command_release(&result);
}

/* ---- While it is written ------------------------------------------------------------------------------------ */

typedef struct stream {
    place folder;
    background film;
    int write;
} stream;

static stream open_stream(void **state)
{
    const place fifo = place_in(*state, "fifo");
    stream s = {.folder = place_in(*state, "film")};
    assert_int_equal(mkfifo(fifo.path, 0600), 0);
    s.film = start_octreel("record - --size 32x18 -o %s <%s", s.folder.path, fifo.path);
    s.write = open(fifo.path, O_WRONLY);
    assert_true(s.write >= 0);
    return s;
}

static void put(const stream *s, const char *text)
{
    assert_int_equal(write(s->write, text, strlen(text)), (ssize_t)strlen(text));
}

static void wait_for_frame(stream *s, uint64_t tick)
{
    wait_for_file(&s->film, frame_place(s->folder.path, tick).path);
}

static void assert_verified(const stream *s, const char *sentence)
{
    command_result result = run_octreel(NULL, "verify %s", s->folder.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, sentence));
    command_release(&result);
}

/* Each frame exists before the next object is written. */
static void frames_are_written_as_ticks_arrive(void **state)
{
    stream s = open_stream(state);
    put(&s, HEADER MOVE(1));
    wait_for_frame(&s, 1);
    put(&s, "{\"tick\":4,\"queries\":[{\"nearest\":[0,0,0]}");
    put(&s, "]}");
    wait_for_frame(&s, 4);
    assert_true(file_exists(frame_place(s.folder.path, 2).path) && file_exists(frame_place(s.folder.path, 3).path));
    put(&s, "\n" MOVE(5));
    wait_for_frame(&s, 5);
    close(s.write);
    command_result result = wait_for_end(&s.film);
    assert_done(&result);
    command_release(&result);
    assert_verified(&s, "identical: 6 ticks, 6 frames");
}

static void signal_while_waiting_leaves_a_whole_recording(void **state)
{
    stream s = open_stream(state);
    put(&s, HEADER MOVE(1) "{\"tick\":2,");
    wait_for_frame(&s, 1);
    assert_int_equal(kill(s.film.pid, SIGINT), 0);
    command_result result = wait_for_end(&s.film);
    assert_int_equal(result.status, 128 + SIGINT);
    assert_non_null(strstr(result.err, "octreel: stopped after 2 ticks; "));
    command_release(&result);
    close(s.write);
    assert_verified(&s, "identical: 2 ticks, 2 frames");
}

static void killed_stream_is_resumed(void **state)
{
    stream s = open_stream(state);
    put(&s, HEADER MOVE(1) MOVE(2));
    wait_for_frame(&s, 2);
    assert_int_equal(kill(s.film.pid, SIGKILL), 0);
    command_result result = wait_for_end(&s.film);
    command_release(&result);
    close(s.write);
    result = run_octreel(NULL, "verify %s", s.folder.path);
    assert_trouble(&result, "the program that records it is still running or was interrupted: octreel record --resume");
    result = run_octreel(NULL, "record --resume -o %s", s.folder.path);
    assert_done(&result);
    command_release(&result);
    assert_verified(&s, "identical: 3 ticks, 3 frames");
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(stream_is_recorded_as_the_same_session_file),
        IN_FOLDER(options_work_as_for_a_file),
        IN_FOLDER(frames_do_not_depend_on_later_ticks),
        IN_FOLDER(options_that_need_a_whole_session_are_refused),
        IN_FOLDER(ticks_before_malformed_text_are_a_whole_recording),
        IN_FOLDER(truncated_session_ends_with_its_last_tick),
        IN_FOLDER(ticks_before_a_crash_are_a_whole_recording),
        IN_FOLDER(frames_are_written_as_ticks_arrive),
        IN_FOLDER(signal_while_waiting_leaves_a_whole_recording),
        IN_FOLDER(killed_stream_is_resumed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
