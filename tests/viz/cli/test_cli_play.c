/* SPDX-License-Identifier: MIT */
/* test_cli_play.c - octreel play writes a page that plays a session without frames, and overwrites only such pages. */
#include <ctype.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "background.h"
#include "commands.h"
#include "fixture.h"
#include "page.h"
#include "page_facts.h"
#include "recordings.h"

#define HEADER "{\"octreel\": \"session\", \"version\": 2,\n"

static void need_pages_that_play(void)
{
    if (page_can_play())
        return;
    print_message("octreel was built without WebAssembly: its pages do not play\n");
    skip();
}

static command_result play_in(const temp_folder *folder, const char *arguments)
{
    return run_script("cd %s && %s play %s", folder->name, octreel_program(), arguments);
}

static void build_without_webassembly_says_so(void **state)
{
    if (page_can_play())
        return;
    command_result result = play_in(*state, "");
    assert_trouble(&result, "built without WebAssembly");
    assert_int_equal(temp_folder_count(*state), 0);
}

/* The test fails unless the facts of a page contain a text. */
static void assert_facts_contain(const char *page, const char *part)
{
    char *text = file_read(page, NULL), *facts = page_facts(text);
    if (!strstr(facts, part))
        fail_msg("the facts of %s do not hold %s", page, part);
    free(facts);
    free(text);
}

static char *read_page_containing(const char *page, const char *part)
{
    char *text = file_read(page, NULL);
    if (!strstr(text, part))
        fail_msg("%s does not hold %s", page, part);
    assert_non_null(strstr(text, "</html>\n"));
    return text;
}

/* The test fails unless the output has the address of a file in the folder of the test, whose path may contain blanks
 * and quotes. */
static void assert_names_address(const char *said, const char *name)
{
    static const char begins[] = "octreel.html: 253 ticks; open it in a browser: file://";
    char path[4096], encoded[3 * sizeof path], *to = encoded;
    assert_non_null(getcwd(path, sizeof path));
    for (const char *at = path; *at; at++)
        to += sprintf(to, isalnum((unsigned char)*at) || strchr("/-._~", *at) ? "%c" : "%%%02X", (unsigned char)*at);
    assert_memory_equal(said, begins, sizeof begins - 1);
    said += sizeof begins - 1;
    assert_memory_equal(said, encoded, strlen(encoded));
    assert_true(said[strlen(encoded)] == '/' && strstr(said, name));
}

static void default_session_becomes_a_page(void **state)
{
    need_pages_that_play();
    command_result result = play_in(*state, "");
    const place page = place_in(*state, "octreel.html");
    assert_done(&result);
    assert_names_address(result.out, page.path);
    assert_facts_contain(page.path, "{\"tick\":251,"); /* tick 252 is like it */
    assert_int_equal(temp_folder_count(*state), 1);
    command_release(&result);
}

static void page_equals_that_of_a_recording_without_frames(void **state)
{
    need_pages_that_play();
    const place page = place_in(*state, "p.html"), film = place_in(*state, "film");
    command_result result = play_in(*state, "--keys=wwd --camera orbit --size 160x90 -o p.html");
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "record --no-frames --keys=wwd --camera orbit --size 160x90 -o %s", film.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, ": 4 ticks, no frames, "));
    assert_null(strstr(result.out, "ffmpeg"));
    command_release(&result);
    char *a = file_read(page.path, NULL), *b = file_read(place_below(film.path, "index.html").path, NULL);
    assert_string_equal(a, b);
    free(a);
    free(b);
}

static void default_page_name_comes_from_the_session(void **state)
{
    need_pages_that_play();
    assert_int_equal(mkdir(place_in(*state, "in").path, 0777), 0);
    file_write_text(place_in(*state, "in/walk 50%.json").path, HEADER "\"points\": [[1, 2, 3]], \"keys\": \"w\"}\n");
    command_result result = play_in(*state, "'in/walk 50%.json'");
    assert_done(&result);
    assert_non_null(strstr(result.out, "walk 50%.html: 2 ticks; "));
    assert_non_null(strstr(result.out, "/walk%2050%25.html\n"));
    command_release(&result);
    free(read_page_containing(place_in(*state, "walk 50%.html").path, "\"keys\": \"w\""));
    result = play_in(*state, "'in/walk 50%.json'"); /* a page of play may be overwritten */
    assert_done(&result);
    command_release(&result);
}

/* A name whose only dot is its first character has no suffix; an empty file may be overwritten. */
static void page_may_have_any_name_and_replace_an_empty_file(void **state)
{
    need_pages_that_play();
    static const char session[] = HEADER "\"keys\": \"w\"}\n";
    const place page = place_in(*state, "p.html");
    file_write_text(place_in(*state, "walk").path, session);
    file_write_text(place_in(*state, ".run").path, session);
    file_write_text(page.path, "");
    command_result result = play_in(*state, "walk");
    assert_non_null(strstr(result.out, "walk.html: 2 ticks; "));
    command_release(&result);
    result = play_in(*state, ".run");
    assert_non_null(strstr(result.out, ".run.html: 2 ticks; "));
    command_release(&result);
    result = play_in(*state, "walk -o \"$(pwd)/p.html\"");
    assert_done(&result);
    assert_non_null(strstr(result.out, "open it in a browser: file:///"));
    assert_non_null(strstr(result.out, "/p.html\n"));
    command_release(&result);
    free(read_page_containing(page.path, "\"keys\": \"w\""));
}

static void points_that_full_leaves_refuse_are_reported(void **state)
{
    need_pages_that_play();
    file_write_text(place_in(*state, "s.json").path,
                    HEADER "\"points\": [[1, 2, 3], [4000, 0, 0], [0, 5000, 0]], \"keys\": \"w\"}\n");
    command_result result = play_in(*state, "s.json");
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.err, "octreel: 2 of the session's 3 points lie outside its world and are refused"));
    command_release(&result);
}

static void only_pages_of_play_are_overwritten(void **state)
{
    need_pages_that_play();
    static const char *const rows[][2] = {
        {"-o mine.html", "mine.html: exists and is not a page made by octreel"},
        {"mine.json -o new.html", "mine.json:1: "},
        {"s.json -o s.json", "s.json"},
        {"-o film/index.html", "-o film/index.html is a file of the recording in film: name another file"},
        {"-o film", "\"film\" is a folder"},
        {"-o p.png", "p.png"},
        {"-o ''", "-o: the name is empty"},
        {"-o none/p.html", "none/p.html"},
        {"s.json mine.html", "unexpected argument \"mine.html\""},
        {"film", "film is a recording"},
        {"--keys=x", "key 1"},
        {"--slice z=5000", "outside the world"},
        {"absent.json", "absent.json: no such file"},
    };
    command_result result = play_in(*state, "-o - | grep -c '</html>'");
    assert_string_equal(result.out, "1\n");
    command_release(&result);
    file_write_text(place_in(*state, "mine.html").path, "<!DOCTYPE html>mine\n");
    file_write_text(place_in(*state, "mine.json").path, "{}\n");
    file_write_text(place_in(*state, "s.json").path, HEADER "\"keys\": \"w\"}\n");
    result = run_octreel(NULL, "record --no-frames --keys=w -o %s", place_in(*state, "film").path);
    assert_done(&result);
    command_release(&result);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        result = play_in(*state, rows[i][0]);
        assert_trouble(&result, rows[i][1]);
        assert_int_equal(temp_folder_count(*state), 4);
    }
    assert_facts_contain(place_in(*state, "film/index.html").path, "{\"tick\":1,");
}

static void every_and_no_frames_contradict_each_other(void **state)
{
    command_result result = run_octreel(NULL, "record --no-frames --every 2 -o %s", place_in(*state, "film").path);
    assert_trouble(&result, "--no-frames and --every contradict each other");
    assert_int_equal(temp_folder_count(*state), 0);
}

/* The pipe is open, but nobody reads it: the page fills it, and the program waits for room. The reader is open before
 * the program starts, because the program refuses a pipe without a reader. The program blocks SIGALRM, as this process
 * does when it starts the program. */
static void signal_ends_a_page_that_nobody_reads(void **state)
{
    const place pipe = place_in(*state, "pipe");
    need_pages_that_play();
    assert_int_equal(mkfifo(pipe.path, 0600), 0);
    const int reader = open(pipe.path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    assert_true(reader >= 0);
    sigset_t alarms;
    sigemptyset(&alarms);
    sigaddset(&alarms, SIGALRM);
    sigprocmask(SIG_BLOCK, &alarms, NULL);
    background b = start_octreel("play -o %s", pipe.path);
    sigprocmask(SIG_UNBLOCK, &alarms, NULL);
    alarm(60);
    assert_int_equal(poll(&(struct pollfd){.fd = reader, .events = POLLIN}, 1, -1), 1);
    kill(b.pid, SIGTERM);
    command_result result = wait_for_end(&b);
    alarm(0);
    close(reader);
    assert_int_equal(result.status, 128 + SIGTERM);
    command_release(&result);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(build_without_webassembly_says_so),
        IN_FOLDER(default_session_becomes_a_page),
        IN_FOLDER(page_equals_that_of_a_recording_without_frames),
        IN_FOLDER(default_page_name_comes_from_the_session),
        IN_FOLDER(page_may_have_any_name_and_replace_an_empty_file),
        IN_FOLDER(points_that_full_leaves_refuse_are_reported),
        IN_FOLDER(only_pages_of_play_are_overwritten),
        IN_FOLDER(every_and_no_frames_contradict_each_other),
        IN_FOLDER(signal_ends_a_page_that_nobody_reads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
