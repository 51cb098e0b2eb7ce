/* SPDX-License-Identifier: MIT */
/* laz_child.c - starts a child process that writes records to a pipe, and reads the pipe in the parent. */
#include "laz_child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* Two pipes: one for records, one for the reason of a failure. Element 0 is the reading end, element 1 the writing
 * end. */
typedef struct pipe_pair {
    int records[2], why[2];
} pipe_pair;

/* ---- The child ---------------------------------------------------------------------------------------------- */

/* Runs in the child process and exits. A crash must not print anything and must not dump core, so signals, core size
 * and standard error are reset first. The reason of a failure is written without blocking, because the parent reads
 * it only after the records. */
static _Noreturn void run_child(const laz_child *child, const pipe_pair *c)
{
    static const int ends[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPIPE, SIGXCPU};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        signal(ends[i], SIG_DFL);
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    setrlimit(RLIMIT_CPU, &(struct rlimit){child->seconds, child->seconds + 1});
    fcntl(c->why[1], F_SETFL, O_NONBLOCK);
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0)
        dup2(nowhere, STDERR_FILENO);
    close(c->records[0]); /* so that the child gets SIGPIPE when the parent stops reading */
    FILE *records = fdopen(c->records[1], "wb"), *why = fdopen(c->why[1], "wb");
    const bool done = records && why && child->produce(child->context, records, why) && fflush(records) == 0;
    if (why)
        fflush(why);
    _exit(done ? 0 : 1);
}

/* ---- The parent --------------------------------------------------------------------------------------------- */

/* Passes records to `add`. Returns false if `add` returns false or if too few records arrive; in the second case
 * *too_few is true. */
static bool pass_records(const cloud_file *file, FILE *records, uint64_t count, laz_record_reader *add, void *context,
                         bool *too_few)
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

/* Sets the error for a child that wrote too few records, from its exit status and the reason that it wrote. */
static bool fail_with_too_few_records(const laz_child *child, const cloud_file *file, int why, int status)
{
    char text[256];
    const ssize_t size = read(why, text, sizeof text);
    for (ssize_t i = 0; i < size; i++)
        text[i] = (char)(text[i] >= ' ' && text[i] <= '~' ? text[i] : '?');
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        return cloud_fail(file, "cannot be decompressed within %u s of processor time", child->seconds);
    if (WIFSIGNALED(status))
        return cloud_fail(file, "cannot be decompressed: liblaszip crashed; the data is probably damaged");
    if (size > 0)
        return cloud_fail(file, "%.*s", (int)size, text);
    return cloud_fail(file, "cannot be decompressed: liblaszip stopped early; the data is probably damaged");
}

/* Reads all records, closes the pipe, and waits for the child process. */
static bool read_records_and_wait(const laz_child *child, const cloud_file *file, pid_t process, const pipe_pair *c,
                                  uint64_t count, laz_record_reader *add, void *context)
{
    FILE *records = fdopen(c->records[0], "rb");
    bool too_few = false;
    int status = 0;
    const bool done = records ? pass_records(file, records, count, add, context, &too_few)
                              : cloud_fail(file, "cannot read the decompressed points: %s", strerror(errno));
    if (records)
        fclose(records);
    else
        close(c->records[0]);
    while (waitpid(process, &status, 0) < 0 && errno == EINTR)
        ;
    return too_few ? fail_with_too_few_records(child, file, c->why[0], status) : done;
}

static bool open_pipes(const cloud_file *file, pipe_pair *c)
{
    const bool first = pipe(c->records) == 0;
    if (first && pipe(c->why) == 0)
        return true;
    cloud_fail(file, "cannot create a pipe for decompression: %s", strerror(errno));
    if (first) {
        close(c->records[0]);
        close(c->records[1]);
    }
    return false;
}

bool laz_child_read_records(const laz_child *child, const cloud_file *file, uint64_t count, laz_record_reader *add,
                            void *context)
{
    pipe_pair c;
    if (!open_pipes(file, &c))
        return false;
    const pid_t process = fork();
    if (process == 0)
        run_child(child, &c);
    close(c.records[1]);
    close(c.why[1]);
    bool done = false;
    if (process > 0) {
        done = read_records_and_wait(child, file, process, &c, count, add, context);
    } else {
        cloud_fail(file, "cannot start a process for decompression: %s", strerror(errno));
        close(c.records[0]);
    }
    close(c.why[0]);
    return done;
}
