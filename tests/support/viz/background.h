/* SPDX-License-Identifier: MIT */
/* background.h - runs octreel in the background of a test, which watches it and sends it signals. */
#ifndef BACKGROUND_H
#define BACKGROUND_H

#include <stdbool.h>
#include <sys/types.h>

#include "commands.h"

typedef struct background {
    pid_t pid;
    int err; /* a pipe from its stderr; its stdout is discarded */
} background;

/* Start octreel with formatted arguments in a new process group. */
background start_octreel(const char *format, ...);

/* Wait until a file exists. False if octreel ends before, and after half a minute. */
bool wait_until_file_exists(const background *b, const char *path);

/* wait_until_file_exists(), and the test fails if it returns false. */
void wait_for_file(background *b, const char *path);

/* The child of a process with this index; 0 if there are fewer children, or no /proc. */
pid_t find_child_process(pid_t parent, unsigned place);

/* Wait until octreel ends. `out` of the result is empty. */
command_result wait_for_end(background *b);

#endif
