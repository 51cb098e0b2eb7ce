/* SPDX-License-Identifier: MIT */
/* failing.c - preloaded into a program: makes the n-th allocation or system call of the program fail, or every thread
 * from the n-th on, or sends SIGTERM before the n-th system call.
 *
 * FAIL_MEMORY, FAIL_CALL, FAIL_THREAD or FAIL_SIGNAL is n, and FAIL_ERROR the errno of a call. A failure creates the
 * file FAILED with its call stack. The file FAIL_SITES gets a line, with the number of the call, for each call stack
 * that is new. An allocation or call is the program's own if the innermost stack frame outside of HELPERS is in the
 * program. Allocations of the C library, libpng and jansson on behalf of the program count. Those of Mesa and of the
 * dynamic loader do not, because these end the program on failure. A program that hangs is killed.
 *
 * With FAIL_SLOW the disk of a program that started jobs is slow: once it has sent something to its jobs, its next
 * write waits until a job waits for room in a socket, or until all jobs have ended. Only calls after that write are
 * counted.
 *
 * A stream whose transfer fails gets another file below it, which stores and returns nothing. Earlier writes are in the
 * first file, the stream's buffer is lost, and closing the stream reports the error, as on a full disk. */
#define _GNU_SOURCE
#undef _FORTIFY_SOURCE /* it has functions of these names inline */
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { CALLS = 64, PAGES = 4096, SITES = 65536, SITE_CALLS = 8, PATIENCE = 60 /* seconds */ };

static const char *const HELPERS[] = {"libc.", "libm.", "libpng", "libz.", "libjansson", "liblzf", "failing."};
static const char *const OWN[] = {"octreel", "liboctree"}; /* beginnings of the names of the program's own files */

typedef enum owner { UNKNOWN, PROGRAM, HELPER, OTHER } owner;

/* The number of the call that fails, and the number of calls so far. */
typedef struct nth {
    unsigned long at; /* 0: none */
    bool all_later;
    atomic_ulong count;
} nth;

static nth memory, call, thread = {.all_later = true};
static int call_error = EIO;
static bool sends_signal; /* instead of failing a call */
static const char *failed, *sites;
static bool ready;
static int full[2] = {-1, -1}; /* with FAIL_SLOW a pipe into which a job writes when its socket is full */
static bool has_jobs, is_slow;
static _Thread_local bool inside;

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

/* ---- Whose ---------------------------------------------------------------------------------------------------- */

static bool begins_with_any(const char *name, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (strncmp(name, words[i], strlen(words[i])) == 0)
            return true;
    return false;
}

static owner look_up(const void *code)
{
    Dl_info info;
    if (!dladdr(code, &info) || !info.dli_fname)
        return OTHER;
    const char *slash = strrchr(info.dli_fname, '/'), *name = slash ? slash + 1 : info.dli_fname;
    if (begins_with_any(name, OWN, sizeof OWN / sizeof *OWN))
        return PROGRAM;
    return begins_with_any(name, HELPERS, sizeof HELPERS / sizeof *HELPERS) ? HELPER : OTHER;
}

/* Pages of code are cached, because a look-up is slow and Mesa allocates often. */
static owner owner_of(const void *code)
{
    static _Atomic uintptr_t known[PAGES]; /* a page and its owner */
    const uintptr_t page = (uintptr_t)code & ~(uintptr_t)4095;
    _Atomic uintptr_t *entry = &known[(page >> 12) % PAGES];
    const uintptr_t there = *entry;
    if ((there & ~(uintptr_t)4095) == page)
        return (owner)(there & 4095);
    const owner found = look_up(code);
    *entry = page | (uintptr_t)found;
    return found;
}

static bool is_own(const void *caller)
{
    void *calls[CALLS];
    owner first = owner_of(caller);
    if (first != HELPER)
        return first == PROGRAM;
    const int count = backtrace(calls, CALLS);
    for (int i = 0; i < count && first == HELPER; i++)
        first = owner_of(calls[i]);
    return first == PROGRAM;
}

/* ---- Failing -------------------------------------------------------------------------------------------------- */

static void note(void)
{
    void *calls[CALLS];
    const int file = failed ? open(failed, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666) : -1;
    if (file < 0)
        return;
    backtrace_symbols_fd(calls, backtrace(calls, CALLS), file);
    close(file);
}

/* If the hashes of two sites begin alike, the second is missed. */
static void note_site(unsigned long number)
{
    static atomic_bool known[SITES];
    void *calls[SITE_CALLS];
    uint64_t hash = 0;
    const int count = backtrace(calls, SITE_CALLS);
    for (int i = 0; i < count; i++)
        hash = (hash ^ (uintptr_t)calls[i]) * UINT64_C(0x9e3779b97f4a7c15);
    const int file = atomic_exchange(&known[hash >> 48], true) ? -1 : open(sites, O_WRONLY | O_CREAT | O_APPEND, 0666);
    if (file < 0)
        return;
    dprintf(file, "%lu\n", number);
    close(file);
}

/* `caller` null: every call counts. */
static bool fails(nth *what, const void *caller)
{
    if (!ready || what->at == 0 || inside)
        return false;
    inside = true;
    const unsigned long number = !caller || is_own(caller) ? atomic_fetch_add(&what->count, 1) + 1 : 0;
    const bool now = number == what->at || (what->all_later && number > what->at);
    if (now)
        note();
    else if (number > 0 && sites)
        note_site(number);
    inside = false;
    if (now && what == &call && sends_signal)
        return kill(getpid(), SIGTERM) != 0;
    if (now)
        errno = what == &call ? call_error : ENOMEM;
    return now;
}

static unsigned long read_number(const char *name)
{
    const char *text = getenv(name);
    return text ? strtoul(text, NULL, 10) : 0;
}

/* A timer of its own: the program may use alarm() and handle SIGALRM. */
static void kill_after_patience(void)
{
    timer_t timer;
    struct sigevent end = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGKILL};
    if (timer_create(CLOCK_MONOTONIC, &end, &timer) != 0 ||
        timer_settime(timer, 0, &(struct itimerspec){.it_value.tv_sec = PATIENCE}, NULL) != 0)
        abort();
}

/* The program's own alarm would end it as if it had not hung. */
unsigned alarm(unsigned seconds)
{
    (void)seconds;
    return 0;
}

__attribute__((constructor)) static void prepare(void)
{
    void *calls[1];
    backtrace(calls, 1); /* it allocates once */
    failed = getenv("FAILED");
    sites = getenv("FAIL_SITES");
    memory.at = read_number("FAIL_MEMORY");
    thread.at = read_number("FAIL_THREAD");
    sends_signal = getenv("FAIL_SIGNAL");
    call.at = read_number(sends_signal ? "FAIL_SIGNAL" : "FAIL_CALL");
    if (getenv("FAIL_ERROR"))
        call_error = (int)read_number("FAIL_ERROR");
    if (getenv("FAIL_SLOW") && pipe(full) != 0)
        abort();
    kill_after_patience();
    ready = full[0] < 0;
}

/* Later calls are not the program's: tests/support/program/coverage_end.c calls this. */
void failing_end(void)
{
    ready = false;
}

/* Find the function of this name that would be called without this file. */
static void find_next(const char *name, void *function)
{
    void *symbol = dlsym(RTLD_NEXT, name);
    memcpy(function, &symbol, sizeof symbol);
}

#define CALLER __builtin_extract_return_addr(__builtin_return_address(0))

void *malloc(size_t size)
{
    return fails(&memory, CALLER) ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    return fails(&memory, CALLER) ? NULL : __libc_calloc(count, size);
}

void *realloc(void *old, size_t size)
{
    return fails(&memory, CALLER) ? NULL : __libc_realloc(old, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return fails(&memory, CALLER) ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void **made, size_t alignment, size_t size)
{
    void *block = fails(&memory, CALLER) ? NULL : __libc_memalign(alignment, size);
    if (block)
        *made = block;
    return block ? 0 : ENOMEM;
}

int pthread_create(pthread_t *made, const pthread_attr_t *how, void *(*run)(void *), void *context)
{
    int (*create)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
    find_next("pthread_create", &create);
    return fails(&thread, NULL) ? EAGAIN : create(made, how, run, context);
}

/* ---- Calls of the system ---------------------------------------------------------------------------------------- */

/* Calls that fail without having done anything. */
#define PLAIN_CALLS(X)                                                                                                 \
    X(int, rename, -1, (const char *from, const char *to), (from, to))                                                 \
    X(int, fsync, -1, (int file), (file))                                                                              \
    X(int, link, -1, (const char *from, const char *to), (from, to))                                                   \
    X(int, unlink, -1, (const char *path), (path))                                                                     \
    X(int, remove, -1, (const char *path), (path))                                                                     \
    X(int, mkdir, -1, (const char *path, mode_t mode), (path, mode))                                                   \
    X(int, rmdir, -1, (const char *path), (path))                                                                      \
    X(int, truncate, -1, (const char *path, off_t size), (path, size))                                                 \
    X(int, ftruncate, -1, (int file, off_t size), (file, size))                                                        \
    X(int, stat, -1, (const char *path, struct stat *out), (path, out))                                                \
    X(int, lstat, -1, (const char *path, struct stat *out), (path, out))                                               \
    X(int, fstat, -1, (int file, struct stat *out), (file, out))                                                       \
    X(int, access, -1, (const char *path, int mode), (path, mode))                                                     \
    X(int, flock, -1, (int file, int operation), (file, operation))                                                    \
    X(off_t, lseek, -1, (int file, off_t by, int whence), (file, by, whence))                                          \
    X(int, fseeko, -1, (FILE * stream, off_t by, int whence), (stream, by, whence))                                    \
    X(off_t, ftello, -1, (FILE * stream), (stream))                                                                    \
    X(DIR *, opendir, NULL, (const char *path), (path))                                                                \
    X(struct dirent *, readdir, NULL, (DIR * folder), (folder))                                                        \
    X(int, socketpair, -1, (int domain, int type, int protocol, int two[2]), (domain, type, protocol, two))            \
    X(int, poll, -1, (struct pollfd * files, nfds_t count, int wait), (files, count, wait))

#define PLAIN_CALL(type, name, failure, parameters, arguments)                                                         \
    type name parameters                                                                                               \
    {                                                                                                                  \
        type(*next) parameters;                                                                                        \
        find_next(#name, &next);                                                                                       \
        return fails(&call, CALLER) ? failure : next arguments;                                                        \
    }
PLAIN_CALLS(PLAIN_CALL)

pid_t fork(void)
{
    pid_t (*next)(void);
    find_next("fork", &next);
    const pid_t child = fails(&call, CALLER) ? -1 : next();
    has_jobs = child > 0; /* not in the child */
    return child;
}

ssize_t send(int socket, const void *bytes, size_t size, int how)
{
    ssize_t (*next)(int, const void *, size_t, int);
    find_next("send", &next);
    if (fails(&call, CALLER))
        return -1;
    is_slow = has_jobs && full[0] >= 0;
    if (!has_jobs && full[1] >= 0) {
        const ssize_t sent = next(socket, bytes, size, how | MSG_DONTWAIT);
        if (sent >= 0 || errno != EAGAIN || write(full[1], "", 1) != 1)
            return sent;
    }
    return next(socket, bytes, size, how);
}

/* Reads and writes may also transfer less than requested: with EINTR they do. */
ssize_t read(int file, void *bytes, size_t size)
{
    ssize_t (*next)(int, void *, size_t);
    find_next("read", &next);
    if (!fails(&call, CALLER))
        return next(file, bytes, size);
    return call_error == EINTR && size > 1 ? next(file, bytes, 1) : -1;
}

int open(const char *path, int how, ...)
{
    int (*next)(const char *, int, ...);
    find_next("open", &next);
    va_list rest;
    va_start(rest, how);
    const mode_t mode = how & O_CREAT ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return fails(&call, CALLER) ? -1 : next(path, how, mode);
}

/* A failing close() closes the file, but may lose data. */
int close(int file)
{
    int (*next)(int);
    find_next("close", &next);
    const bool failing = fails(&call, CALLER);
    const int result = next(file);
    if (failing)
        errno = call_error;
    return failing ? -1 : result;
}

static void put_below(FILE *stream, const char *path, int how)
{
    const int file = fileno(stream);
    const int other = file < 0 ? -1 : open(path, how | O_CLOEXEC);
    if (other >= 0) {
        dup2(other, file);
        close(other);
    }
}

static void spoil_reading(FILE *stream)
{
    inside = true;
    put_below(stream, "/proc/self/mem", O_RDONLY); /* where nothing is mapped: EIO */
    inside = false;
}

static void spoil_writing(FILE *stream)
{
    inside = true;
    put_below(stream, "/dev/full", O_WRONLY);
    inside = false;
}

/* The first transfer of the stream may fail. */
static FILE *opened(FILE *stream, const char *mode, const void *caller)
{
    if (stream && fails(&call, caller))
        (*mode == 'r' ? spoil_reading : spoil_writing)(stream);
    return stream;
}

FILE *fopen(const char *restrict path, const char *restrict mode)
{
    FILE *(*next)(const char *, const char *);
    find_next("fopen", &next);
    return fails(&call, CALLER) ? NULL : opened(next(path, mode), mode, CALLER);
}

FILE *fdopen(int file, const char *mode)
{
    FILE *(*next)(int, const char *);
    find_next("fdopen", &next);
    return fails(&call, CALLER) ? NULL : opened(next(file, mode), mode, CALLER);
}

size_t fread(void *restrict bytes, size_t size, size_t count, FILE *restrict stream)
{
    size_t (*next)(void *, size_t, size_t, FILE *);
    find_next("fread", &next);
    if (fails(&call, CALLER))
        spoil_reading(stream);
    return next(bytes, size, count, stream);
}

static void wait_as_slow_disk(void)
{
    char byte;
    if (!is_slow)
        return;
    is_slow = false;
    inside = true;
    close(full[1]); /* only jobs have the other copies */
    while (read(full[0], &byte, 1) < 0 && errno == EINTR)
        continue;
    close(full[0]);
    full[0] = full[1] = -1;
    inside = false;
    ready = true;
}

size_t fwrite(const void *restrict bytes, size_t size, size_t count, FILE *restrict stream)
{
    size_t (*next)(const void *, size_t, size_t, FILE *);
    find_next("fwrite", &next);
    wait_as_slow_disk();
    if (fails(&call, CALLER))
        spoil_writing(stream);
    return next(bytes, size, count, stream);
}

int fflush(FILE *stream)
{
    int (*next)(FILE *);
    find_next("fflush", &next);
    if (stream && fails(&call, CALLER))
        spoil_writing(stream);
    return next(stream);
}

int fclose(FILE *stream)
{
    int (*next)(FILE *);
    find_next("fclose", &next);
    const bool failing = fails(&call, CALLER);
    const int result = next(stream);
    if (failing)
        errno = call_error;
    return failing ? EOF : result;
}
