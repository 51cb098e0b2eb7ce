/* SPDX-License-Identifier: MIT */
#include "laz_child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* Two pipes: what is read of each and what is written. */
typedef struct channels {
    int records[2], why[2];
} channels;

/* ---- The other process -------------------------------------------------------------------------------------- */

/* Whatever ends it does so in silence. What does not fit the pipe of reasons is lost: nobody reads it before the
 * records. What is open is closed by the system. */
static _Noreturn void run(const laz_child *child, const channels *c)
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
    close(c->records[0]); /* so that it ends when who reads does */
    FILE *records = fdopen(c->records[1], "wb"), *why = fdopen(c->why[1], "wb");
    const bool done = records && why && child->put(child->context, records, why) && fflush(records) == 0;
    if (why)
        fflush(why);
    _exit(done ? 0 : 1);
}

/* ---- This process ------------------------------------------------------------------------------------------- */

/* Take the records that come. False where they are too few, or where `add` fails, with its error. */
static bool take_records(const cloud_file *file, FILE *records, uint64_t count, laz_add *add, void *context, bool *few)
{
    unsigned char record[LAS_RECORD_READ];
    for (uint64_t i = 0; i < count; i++) {
        cloud_tell(file, i, i, count);
        *few = fread(record, 1, sizeof record, records) != sizeof record;
        if (*few || !add(context, record))
            return false;
    }
    return true;
}

static bool fail_few(const laz_child *child, const cloud_file *file, int why, int status)
{
    char text[256];
    const ssize_t size = read(why, text, sizeof text);
    for (ssize_t i = 0; i < size; i++)
        text[i] = (char)(text[i] >= ' ' && text[i] <= '~' ? text[i] : '?');
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        return cloud_fail(file, "cannot be decompressed: it takes more than %u s of processor time", child->seconds);
    if (WIFSIGNALED(status))
        return cloud_fail(file, "cannot be decompressed: liblaszip crashed at its data");
    if (size > 0)
        return cloud_fail(file, "%.*s", (int)size, text);
    return cloud_fail(file, "cannot be decompressed: liblaszip broke off at its data");
}

static bool take_all(const laz_child *child, const cloud_file *file, pid_t process, const channels *c, uint64_t count,
                     laz_add *add, void *context)
{
    FILE *records = fdopen(c->records[0], "rb");
    bool few = false;
    int status = 0;
    const bool done = records ? take_records(file, records, count, add, context, &few)
                              : cloud_fail(file, "the decompressed points cannot be read: %s", strerror(errno));
    if (records)
        fclose(records);
    else
        close(c->records[0]);
    while (waitpid(process, &status, 0) < 0 && errno == EINTR)
        ;
    return few ? fail_few(child, file, c->why[0], status) : done;
}

static bool open_channels(const cloud_file *file, channels *c)
{
    const bool first = pipe(c->records) == 0;
    if (first && pipe(c->why) == 0)
        return true;
    cloud_fail(file, "a pipe for decompression cannot be made: %s", strerror(errno));
    if (first) {
        close(c->records[0]);
        close(c->records[1]);
    }
    return false;
}

bool laz_child_take(const laz_child *child, const cloud_file *file, uint64_t count, laz_add *add, void *context)
{
    channels c;
    if (!open_channels(file, &c))
        return false;
    const pid_t process = fork();
    if (process == 0)
        run(child, &c);
    close(c.records[1]);
    close(c.why[1]);
    bool done = false;
    if (process > 0) {
        done = take_all(child, file, process, &c, count, add, context);
    } else {
        cloud_fail(file, "a process for decompression cannot be started: %s", strerror(errno));
        close(c.records[0]);
    }
    close(c.why[0]);
    return done;
}
