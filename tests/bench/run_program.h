/* SPDX-License-Identifier: MIT */
/* run_program.h - runs a program as a child, and measures its time, its memory and its exit status. */
#ifndef BENCH_RUN_PROGRAM_H
#define BENCH_RUN_PROGRAM_H

#include <stdbool.h>

typedef struct program_run {
    double ms;    /* from start to end, by the clock on the wall */
    double cpu;   /* milliseconds of all its threads: what else the machine does is hardly counted */
    long peak_kb; /* the most memory it held */
    int status;   /* of its exit; -1 when a signal ended it */
} program_run;

/* Run argv[0], looked for in PATH, with what it says thrown away. False when it cannot be started. */
bool run_program(const char *const *argv, program_run *run);

/* Whether a program of this name, or at this path, can be started. */
bool program_exists(const char *name);

#endif
