/* SPDX-License-Identifier: MIT */
/* test_jobs.c - a recording by several processes has the bytes of one process, even if a process is stopped or killed.
 */
#define _GNU_SOURCE /* for leases of files, if the system has them */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "background.h"
#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "recordings.h"
#include "tick_lines.h"

/* A session of far more ticks than are recorded before a signal comes. */
#define LONG_SESSION                                                                                                   \
    "{\"octreel\": \"session\", \"version\": 2, \"points\": {\"sample\": \"clustered\", \"count\": 200, \"seed\": "    \
    "1}, "                                                                                                             \
    "\"ticks\": 4000}\n"

static void assert_recorded(const char *arguments, const char *folder)
{
    command_result result = run_octreel(NULL, "record --size 160x90 %s -o %s", arguments, folder);
    assert_done(&result);
    command_release(&result);
}

static void bytes_do_not_depend_on_the_number_of_jobs(void **state)
{
    static const char *const views[] = {"--keys wwddeennwwddssaawd", "--every 7 --camera orbit", "--ticks 30:47"};
    static const char *const jobs[] = {"--jobs 2", "--jobs 3", "--jobs 5", "--jobs 256", ""};
    for (size_t i = 0; i < 3; i++) {
        char name[16], arguments[128];
        snprintf(name, sizeof name, "one%zu", i);
        const place one = place_in(*state, name);
        snprintf(arguments, sizeof arguments, "--jobs 1 %s", views[i]);
        assert_recorded(arguments, one.path);
        for (size_t j = 0; j < (i == 0 ? 5 : 2); j++) {
            snprintf(name, sizeof name, "many%zu%zu", i, j);
            snprintf(arguments, sizeof arguments, "%s %s", jobs[j], views[i]);
            const place many = place_in(*state, name);
            assert_recorded(arguments, many.path);
            assert_same_folders(one.path, many.path, NULL);
        }
    }
}

static void chunks_by_several_jobs_join_to_the_same_bytes(void **state)
{
    const place one = place_in(*state, "one"), parts = place_in(*state, "parts");
    assert_recorded("--jobs 1 --every 2 --keys wwddeennwwddssaawd", one.path);
    assert_recorded("--jobs 2 --every 2 --keys wwddeennwwddssaawd --ticks 7:", parts.path);
    assert_recorded("--jobs 3 --every 2 --keys wwddeennwwddssaawd --ticks :7", parts.path);
    command_result result = run_octreel(NULL, "join %s", parts.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(one.path, parts.path, NULL);
}

static void summary_equals_that_of_one_process(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    json_t *summaries[2];
    for (int i = 0; i < 2; i++) {
        command_result result = run_octreel(NULL, "record --size 160x90 --budget 5 --every 3 --json --jobs %d -o %s",
                                            i + 1, i == 0 ? a.path : b.path);
        assert_done(&result);
        summaries[i] = json_read(result.out);
        json_object_del(summaries[i], "folder");
        json_object_del(summaries[i], "seconds");
        json_object_del(summaries[i], "frames_per_second");
        command_release(&result);
    }
    assert_true(json_equal(summaries[0], summaries[1]));
    assert_true(json_real_value(json_member(summaries[0], "over_budget")) > 0);
    json_decref(summaries[0]);
    json_decref(summaries[1]);
}

static void default_is_one_job_per_core_with_enough_frames_for_each(void **state)
{
    octree_session session = octree_session_default();
    film_options options = small_film("film");
    (void)state;
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    session.keys = NULL;
    session.ticks = 99999;
    assert_int_equal(film_default_jobs(&session, &options), cores > FILM_MOST_JOBS ? FILM_MOST_JOBS : cores);
    session.ticks = 20;
    assert_int_equal(film_default_jobs(&session, &options), 1);
    session.ticks = 99999;
    options.every = 50000;
    assert_int_equal(film_default_jobs(&session, &options), 1);
    options = chunk_of(small_film("film"), 500, 510);
    assert_int_equal(film_default_jobs(&session, &options), 1);
    options = chunk_of(small_film("film"), 100000, 100001); /* sessions that are refused later */
    assert_int_equal(film_default_jobs(&session, &options), 1);
}

static void refused_session_is_reported_once_and_writes_nothing(void **state)
{
    const place folder = place_in(*state, "film");
    command_result result = run_octreel(NULL, "record --jobs 3 --size 99999x1 -o %s", folder.path);
    assert_trouble(&result, "1 to 16384");
    assert_false(file_exists(folder.path));
    assert_int_equal(temp_folder_count(*state), 0);
}

/* The test fails unless the stopped recording is resumed to the bytes of an uninterrupted one. */
static void assert_resumes(void **state, const char *folder, const char *session)
{
    const place whole = place_in(*state, "whole");
    command_result result = run_octreel(NULL, "record --resume -o %s", folder);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "record %s --size 160x90 --every 100 -o %s", session, whole.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(whole.path, folder, NULL);
}

static place long_session(void **state)
{
    const place session = place_in(*state, "s.json");
    file_write_text(session.path, LONG_SESSION);
    return session;
}

static void error_names_a_killed_job(void **state)
{
    const place session = long_session(state), folder = place_in(*state, "film");
    background b = start_octreel("record %s --size 160x90 --jobs 2 -o %s", session.path, folder.path);
    wait_for_file(&b, frame_place(folder.path, 2).path);
    const pid_t job = find_child_process(b.pid, 1);
    if (job == 0) {
        kill(-b.pid, SIGKILL);
        command_result ended = wait_for_end(&b);
        command_release(&ended);
        skip(); /* the system has no /proc */
    }
    kill(job, SIGKILL);
    command_result result = wait_for_end(&b);
    assert_non_null(strstr(result.err, " of 2 was killed by signal 9 (Killed); --resume records the missing ticks"));
    assert_trouble(&result, "job ");
    const size_t lines = for_each_line(folder.path, NULL, NULL);
    assert_true(lines >= 1 && lines < 4000);
    for (uint64_t tick = 0; tick < lines; tick++)
        assert_true(file_exists(frame_place(folder.path, tick).path));
}

static void stopped_jobs_report_the_command_to_continue(void **state)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    const place session = long_session(state);
    for (size_t i = 0; i < 4; i++) {
        char name[16], sentence[2048];
        const int sent = signals[i % 3];
        snprintf(name, sizeof name, "film%zu", i);
        const place folder = place_in(*state, name);
        background b =
            start_octreel("record %s --size 160x90 --jobs %d -o %s", session.path, i % 2 == 0 ? 2 : 1, folder.path);
        wait_for_file(&b, frame_place(folder.path, 4).path);
        kill(i < 2 ? b.pid : -b.pid, sent); /* send to one process, as kill does, or to all, as a terminal does */
        command_result result = wait_for_end(&b);
        assert_int_equal(result.status, 128 + sent);
        snprintf(sentence, sizeof sentence, " record --resume -o %s\n", folder.path);
        assert_non_null(strstr(result.err, "octreel: stopped after "));
        assert_non_null(strstr(result.err, " ticks; to continue: "));
        assert_string_equal(result.err + strlen(result.err) - strlen(sentence), sentence);
        assert_nothing_half_written(folder.path);
        assert_true(file_exists(place_below(folder.path, "index.html").path));
        const size_t lines = for_each_line(folder.path, NULL, NULL);
        assert_true(lines >= 1 && lines < 4000); /* the second job may have been slow */
        assert_int_equal(strtoul(result.err + strlen("octreel: stopped after "), NULL, 10), lines);
        for (uint64_t tick = 0; tick < lines; tick++)
            assert_true(file_exists(frame_place(folder.path, tick).path));
        command_release(&result);
    }
}

static void stopped_recording_of_several_jobs_is_resumed(void **state)
{
    const place session = long_session(state), folder = place_in(*state, "film");
    background b = start_octreel("record %s --size 160x90 --every 100 --jobs 2 -o %s", session.path, folder.path);
    wait_for_file(&b, frame_place(folder.path, 300).path);
    kill(b.pid, SIGTERM);
    command_result result = wait_for_end(&b);
    command_release(&result);
    assert_nothing_half_written(folder.path);
    assert_resumes(state, folder.path, session.path);
}

/* Take a lease of a file: a process that opens the file waits until the lease is given back, for up to 45 s. Returns -1
 * if the system has no leases. */
static int lease(const char *path)
{
#ifdef F_SETLEASE
    const int file = open(path, O_RDWR);
    signal(SIGIO, SIG_IGN);
    if (file < 0 || fcntl(file, F_SETLEASE, F_WRLCK) == 0)
        return file;
    close(file);
#endif
    (void)path;
    return -1;
}

/* A job that waits for a file, which another process holds, ends with the process that started it, and not only after
 * its frame. */
static void killing_the_parent_ends_jobs_within_a_frame(void **state)
{
    enum { PATIENCE = 20000 }; /* milliseconds until the test fails */
    const place folder = place_in(*state, "film");
    char said[256];
    assert_recorded("--jobs 1 --keys wdnwdnwdnwdnwdnwdnwdn", folder.path);
    remove(frame_place(folder.path, 20).path);
    const int held = lease(frame_place(folder.path, 1).path);
    if (held < 0)
        skip();
    background b = start_octreel("record --resume --jobs 2 -o %s", folder.path);
    wait_for_file(&b, frame_place(folder.path, 20).path); /* a frame of the other job, which has got far beyond */
    kill(b.pid, SIGKILL);
    struct pollfd all_ended = {.fd = b.err, .events = POLLIN};
    const bool ended = poll(&all_ended, 1, PATIENCE) == 1 && read(b.err, said, sizeof said) == 0;
    close(held);
    command_result result = wait_for_end(&b);
    assert_int_equal(result.status, 128 + SIGKILL);
    command_release(&result);
    assert_true(ended);
    result = run_octreel(NULL, "record --resume -o %s", folder.path);
    assert_done(&result);
    command_release(&result);
}

/* The jobs end by themselves: no further frame appears. */
static void killing_the_parent_leaves_no_job(void **state)
{
    const struct timespec while_frames_end = {0, 200000000};
    const place session = long_session(state), folder = place_in(*state, "film");
    background b = start_octreel("record %s --size 160x90 --every 100 --jobs 2 -o %s", session.path, folder.path);
    wait_for_file(&b, frame_place(folder.path, 300).path);
    kill(b.pid, SIGKILL);
    command_result result = wait_for_end(&b); /* returns when every process that could write to stderr has ended */
    assert_int_equal(result.status, 128 + SIGKILL);
    command_release(&result);
    nanosleep(&while_frames_end, NULL);
    listing before = folder_list(folder.path);
    nanosleep(&while_frames_end, NULL);
    listing after = folder_list(folder.path);
    assert_int_equal(before.count, after.count);
    listing_release(&before);
    listing_release(&after);
    assert_resumes(state, folder.path, session.path);
}

static void ignored_signals_stay_ignored(void **state)
{
    const place folder = place_in(*state, "film");
    signal(SIGHUP, SIG_IGN); /* as under nohup */
    background b = start_octreel("record --size 160x90 --jobs 2 -o %s", folder.path);
    signal(SIGHUP, SIG_DFL);
    wait_for_file(&b, frame_place(folder.path, 4).path);
    kill(-b.pid, SIGHUP);
    command_result result = wait_for_end(&b);
    assert_done(&result);
    command_release(&result);
    assert_int_equal(for_each_line(folder.path, NULL, NULL), 253);
}

/* Messages of this process to its jobs fail; see tests/CMakeLists.txt. */
static pid_t fails_in;

ssize_t __real_send(int socket, const void *bytes, size_t size, int how);
ssize_t __wrap_send(int socket, const void *bytes, size_t size, int how);

ssize_t __wrap_send(int socket, const void *bytes, size_t size, int how)
{
    if (getpid() != fails_in)
        return __real_send(socket, bytes, size, how);
    errno = ENOBUFS;
    return -1;
}

/* Otherwise the jobs would wait for their work, and this process for the jobs. */
static void jobs_that_never_got_their_work_are_not_awaited(void **state)
{
    const place folder = place_in(*state, "film");
    const octree_session session = short_session("wdn");
    film_options options = small_film(folder.path);
    film_summary summary;
    octreel_error error = {""};
    options.jobs = 2;
    fails_in = getpid();
    alarm(20);
    assert_false(film_session(&session, &options, &summary, &error));
    alarm(0);
    fails_in = 0;
    assert_string_equal(error.text, "cannot send the session digest to job 1 of 2: No buffer space available");
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(bytes_do_not_depend_on_the_number_of_jobs),
        IN_FOLDER(chunks_by_several_jobs_join_to_the_same_bytes),
        IN_FOLDER(summary_equals_that_of_one_process),
        cmocka_unit_test(default_is_one_job_per_core_with_enough_frames_for_each),
        IN_FOLDER(refused_session_is_reported_once_and_writes_nothing),
        IN_FOLDER(error_names_a_killed_job),
        IN_FOLDER(jobs_that_never_got_their_work_are_not_awaited),
        IN_FOLDER(stopped_jobs_report_the_command_to_continue),
        IN_FOLDER(stopped_recording_of_several_jobs_is_resumed),
        IN_FOLDER(killing_the_parent_ends_jobs_within_a_frame),
        IN_FOLDER(killing_the_parent_leaves_no_job),
        IN_FOLDER(ignored_signals_stay_ignored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
