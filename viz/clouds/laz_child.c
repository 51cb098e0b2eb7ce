/* SPDX-License-Identifier: MIT */
/* laz_child.c - starts a child process and reads its output. The child writes records to a pipe. A child that fails
 * writes the reason to a temporary file. */
#include "laz_child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- The child ---------------------------------------------------------------------------------------------- */

/* Runs in the child process and never returns. If the child crashes, it must not print anything and must not dump
 * core. Signal handlers, the limit of core files and standard error are therefore reset first. */
static _Noreturn void run_child(const laz_child *child, const int pipe_ends[2], FILE *why)
{
    static const int ends[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPIPE, SIGXCPU};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        signal(ends[i], SIG_DFL);
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    setrlimit(RLIMIT_CPU, &(struct rlimit){child->seconds, child->seconds + 1});
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0)
        dup2(nowhere, STDERR_FILENO);
    /* the child closes its read end of the pipe, so that the child gets SIGPIPE when the parent stops reading */
    close(pipe_ends[0]);
    FILE *records = fdopen(pipe_ends[1], "wb");
    const bool done = records && child->produce(child->context, records, why) && fflush(records) == 0;
    fflush(why);
    _exit(done ? 0 : 1);
}

/* ---- The parent --------------------------------------------------------------------------------------------- */

/* Passes records from the pipe to `add`. Returns false if `add` returns false or if fewer than `count` records
 * arrive. If too few arrive, sets *too_few to true. */
static bool read_records_from_pipe(const cloud_file *file, FILE *records, uint64_t count, laz_record_reader *add,
                                   void *context, bool *too_few)
{
    unsigned char record[LAS_RECORD_READ];
    for (uint64_t i = 0; i < count; i++) {
        cloud_report_progress(file, i, i, count);
        *too_few = fread(record, 1, sizeof record, records) != sizeof record;
        if (*too_few || !add(context, record))
            return false;
    }
    return true;
}

/* Sets the error after the child wrote too few records, from the child's exit status and the reason that the child
 * wrote. Returns false. */
static bool fail_with_too_few_records(const laz_child *child, const cloud_file *file, FILE *why, int status)
{
    char text[256];
    rewind(why);
    const size_t size = fread(text, 1, sizeof text, why);
    for (size_t i = 0; i < size; i++)
        text[i] = (char)(text[i] >= ' ' && text[i] <= '~' ? text[i] : '?');
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        return cloud_fail(file, "cannot be decompressed within %u s of processor time", child->seconds);
    if (WIFSIGNALED(status))
        return cloud_fail(file, "cannot be decompressed: liblaszip crashed; the data is probably damaged");
    if (size > 0)
        return cloud_fail(file, "%.*s", (int)size, text);
    return cloud_fail(file, "cannot be decompressed: liblaszip stopped early; the data is probably damaged");
}

bool laz_child_read_records(const laz_child *child, const cloud_file *file, uint64_t count, laz_record_reader *add,
                            void *context)
{
    int pipe_ends[2], status = 0;
    bool too_few = false;
    FILE *why = tmpfile();
    if (!why)
        why = fopen("/dev/null", "r+b"); /* if no temporary file can be created, errors contain no reason */
    if (!why || pipe(pipe_ends) != 0) {
        cloud_fail(file, "cannot create a temporary file and a pipe for decompression: %s", strerror(errno));
        if (why)
            fclose(why);
        return false;
    }
    const pid_t process = fork();
    if (process == 0)
        run_child(child, pipe_ends, why);
    close(pipe_ends[1]);
    FILE *records = process > 0 ? fdopen(pipe_ends[0], "rb") : NULL;
    bool done = records ? read_records_from_pipe(file, records, count, add, context, &too_few)
                        : cloud_fail(file, "cannot start a process for decompression: %s", strerror(errno));
    if (records)
        fclose(records);
    else
        close(pipe_ends[0]);
    while (process > 0 && waitpid(process, &status, 0) < 0 && errno == EINTR)
        ;
    if (too_few)
        done = fail_with_too_few_records(child, file, why, status);
    fclose(why);
    return done;
}
