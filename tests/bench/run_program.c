/* SPDX-License-Identifier: MIT */
/* run_program.c - see run_program.h. */
#include "run_program.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { NOT_STARTED = 127 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static double in_ms(const struct timeval *time)
{
    return 1e3 * (double)time->tv_sec + 1e-3 * (double)time->tv_usec;
}

static pid_t start(const char *const *argv)
{
    const pid_t child = fork();
    if (child != 0)
        return child;
    const int nowhere = open("/dev/null", O_RDWR);
    if (nowhere >= 0 && dup2(nowhere, STDOUT_FILENO) >= 0 && dup2(nowhere, STDERR_FILENO) >= 0)
        execvp(argv[0], (char *const *)(uintptr_t)argv);
    _exit(NOT_STARTED);
}

static program_run measure(const char *const *argv)
{
    program_run run = {.status = NOT_STARTED};
    struct rusage usage;
    int status = 0;
    const double started = now();
    const pid_t child = start(argv);
    if (child < 0)
        return run;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    run.ms = now() - started;
    run.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (getrusage(RUSAGE_CHILDREN, &usage) == 0) {
        run.peak_kb = usage.ru_maxrss;
        run.cpu = in_ms(&usage.ru_utime) + in_ms(&usage.ru_stime);
    }
    return run;
}

/* The peak of children is one number for all that a process ever had: each run has a process of its own around it. */
bool run_program(const char *const *argv, program_run *run)
{
    int ends[2];
    *run = (program_run){.status = NOT_STARTED};
    if (pipe(ends) != 0)
        return false;
    const pid_t between = fork();
    if (between == 0) {
        const program_run measured = measure(argv);
        _exit(write(ends[1], &measured, sizeof measured) == sizeof measured ? 0 : 1);
    }
    close(ends[1]);
    const bool told = between > 0 && read(ends[0], run, sizeof *run) == sizeof *run;
    close(ends[0]);
    if (between > 0)
        waitpid(between, NULL, 0);
    return told && run->status != NOT_STARTED;
}

bool program_exists(const char *name)
{
    program_run run;
    const char *const argv[] = {name, "--version", NULL};
    return run_program(argv, &run);
}
