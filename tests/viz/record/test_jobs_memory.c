/* SPDX-License-Identifier: MIT */
/* test_jobs_memory.c - jobs whose ticks fill their sockets wait for a starter that is slow, stopped or out of memory,
 * and always end. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "failing_memory.h"
#include "files.h"
#include "fixture.h"
#include "recordings.h"
#include "session_texts.h"

/* A session whose ticks have lines of 290 kB each, because ids have 16 digits; a socket holds less than 250 kB. */
static session_file read_session_with_long_lines(void)
{
    static char text[1 << 16];
    char *at = text + sprintf(text, "{\"octreel\": \"session\", \"version\": 2, \"ticks\": 7, \"queries\": [");
    for (int i = 0; i < 20; i++)
        at += sprintf(at, "%s{\"radius\": %d, \"at\": [0, 0, 0]}", i ? ", " : "", 4000 + i);
    at += sprintf(at, "], \"points\": [");
    for (int i = 0; i < 800; i++)
        at += sprintf(at, "%s[%d, %d, %d, 900719925474%04d]", i ? ", " : "", i - 400, i % 37, i % 41, i);
    sprintf(at, "]}\n");
    return session_of_text(text);
}

/* ---- A slow starter ------------------------------------------------------------------------------------------- */

static pid_t starter;
static int full[2]; /* a pipe into which a job writes when its socket is full */

ssize_t __real_send(int socket, const void *bytes, size_t size, int how);
ssize_t __wrap_send(int socket, const void *bytes, size_t size, int how);

ssize_t __wrap_send(int socket, const void *bytes, size_t size, int how)
{
    if (getpid() == starter)
        return __real_send(socket, bytes, size, how);
    const ssize_t sent = __real_send(socket, bytes, size, how | MSG_DONTWAIT);
    if (sent >= 0 || errno != EAGAIN)
        return sent;
    assert_int_equal(write(full[1], "f", 1), 1);
    return __real_send(socket, bytes, size, how);
}

/* What the starter does once a job waits for room in its socket. */
typedef struct plan {
    long memory; /* number of allocations that succeed after that; below 0: all */
    bool stops;
    uint64_t done;
} plan;

static void be_slow(uint64_t done, uint64_t total, void *context)
{
    plan *p = context;
    char byte;
    (void)total;
    p->done = done;
    if (done > 1)
        return;
    assert_int_equal(read(full[0], &byte, 1), 1);
    fail_allocations_after(p->memory);
}

static bool goes_on(void *context)
{
    const plan *p = context;
    return !p->stops || p->done == 0;
}

/* Record with two jobs. The test fails if a job has not ended. */
static bool record_by_jobs(const char *folder, plan *p, octreel_error *error)
{
    session_file file = read_session_with_long_lines();
    film_options options = small_film(folder);
    film_summary summary;
    options.jobs = 2;
    options.watch = (watcher){be_slow, goes_on, p};
    starter = getpid();
    assert_int_equal(pipe(full), 0);
    alarm(60);
    const bool done = film_session(&file.session, &options, &summary, error);
    memory_has_failed();
    alarm(0);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
    close(full[0]);
    close(full[1]);
    session_release(&file);
    return done;
}

static void slow_starter_records_the_same_bytes(void **state)
{
    const place one = place_in(*state, "one"), two = place_in(*state, "two");
    session_file file = read_session_with_long_lines();
    const film_options options = small_film(one.path);
    octreel_error error;
    assert_filmed(&file.session, &options);
    session_release(&file);
    assert_true(record_by_jobs(two.path, &(plan){.memory = -1}, &error));
    assert_same_folders(one.path, two.path, NULL);
}

static void stopped_starter_does_not_wait_for_full_sockets(void **state)
{
    const place folder = place_in(*state, "film");
    octreel_error error;
    assert_true(record_by_jobs(folder.path, &(plan){.memory = -1, .stops = true}, &error));
    assert_true(for_each_line(folder.path, NULL, NULL) < 8);
}

/* Otherwise the starter waits for the end of a job, and the job for room in its socket. */
static void starter_out_of_memory_does_not_wait_for_full_sockets(void **state)
{
    for (long memory = 0; memory < 3; memory++) {
        char name[16];
        octreel_error error = {""};
        snprintf(name, sizeof name, "film%ld", memory);
        assert_false(record_by_jobs(place_in(*state, name).path, &(plan){.memory = memory}, &error));
        assert_non_null(strstr(error.text, "out of memory"));
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(slow_starter_records_the_same_bytes),
        IN_FOLDER(stopped_starter_does_not_wait_for_full_sockets),
        IN_FOLDER(starter_out_of_memory_does_not_wait_for_full_sockets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
