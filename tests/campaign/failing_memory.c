/* SPDX-License-Identifier: MIT */
/* failing_memory.c - preloaded into a program: the n-th allocation that it makes itself fails, or each
 * thread from the n-th on.
 *
 * FAIL_MEMORY or FAIL_THREAD is n. What fails makes the file FAILED, with the calls that led to it. An
 * allocation is the program's own where the first code on the way to it that is not of HELPERS is the program's: what
 * the C library, libpng and jansson need for it counts, and what Mesa and the loader of libraries need does not, which
 * end a program where they please. A program that hangs is ended.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { CALLS = 64, PAGES = 4096, PATIENCE = 60 /* seconds */ };

static const char *const HELPERS[] = {"libc.", "libm.", "libpng", "libz.", "libjansson", "liblzf", "failing_memory"};
static const char *const OWN[] = {"octreel", "liboctree"}; /* how names of the program's own files begin */

typedef enum owner { UNKNOWN, PROGRAM, HELPER, OTHER } owner;

/* Which fails, and how many there were. */
typedef struct nth {
    unsigned long at; /* 0: none */
    bool all_later;
    atomic_ulong count;
} nth;

static nth memory, thread = {.all_later = true};
static const char *failed;
static bool ready;
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

/* Looking up takes a while, and Mesa allocates much: pages of code are kept in mind. */
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

/* `caller` null: whoever asks counts. */
static bool fails(nth *what, const void *caller)
{
    if (!ready || what->at == 0 || inside)
        return false;
    inside = true;
    const unsigned long number = !caller || is_own(caller) ? atomic_fetch_add(&what->count, 1) + 1 : 0;
    const bool now = number == what->at || (what->all_later && number > what->at);
    if (now)
        note();
    inside = false;
    if (now)
        errno = ENOMEM;
    return now;
}

static unsigned long read_number(const char *name)
{
    const char *text = getenv(name);
    return text ? strtoul(text, NULL, 10) : 0;
}

__attribute__((constructor)) static void prepare(void)
{
    void *calls[1];
    backtrace(calls, 1); /* it allocates once */
    failed = getenv("FAILED");
    memory.at = read_number("FAIL_MEMORY");
    thread.at = read_number("FAIL_THREAD");
    alarm(PATIENCE);
    ready = true;
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
    void *symbol = dlsym(RTLD_NEXT, "pthread_create");
    memcpy(&create, &symbol, sizeof create);
    return fails(&thread, NULL) ? EAGAIN : create(made, how, run, context);
}
