/* SPDX-License-Identifier: MIT */
/* coverage_end.c - linked into each program by tests/coverage: the counters of a process are written whatever a test
 * does to it, and where it leaves by _exit(). */
#define _GNU_SOURCE /* RTLD_DEFAULT */
#include <dlfcn.h>
#include <string.h>
#include <sys/resource.h>

void __gcov_dump(void);
_Noreturn void __real__exit(int status);
_Noreturn void __wrap__exit(int status);

/* Destructors run before the counters are written. What writes them is not the program's: nothing that is preloaded
 * lets it fail, and no limit of a file's size holds. */
static __attribute__((destructor)) void end_failures(void)
{
    struct rlimit limit;
    void (*end)(void), *symbol = dlsym(RTLD_DEFAULT, "failing_end");
    memcpy(&end, &symbol, sizeof end);
    if (symbol)
        end();
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0) {
        limit.rlim_cur = limit.rlim_max;
        setrlimit(RLIMIT_FSIZE, &limit);
    }
}

_Noreturn void __wrap__exit(int status)
{
    end_failures();
    __gcov_dump();
    __real__exit(status);
}
