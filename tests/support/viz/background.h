/* SPDX-License-Identifier: MIT */
/* background.h - octreel run beside a test, which watches it and sends it signals. */
#ifndef BACKGROUND_H
#define BACKGROUND_H

#include <stdbool.h>
#include <sys/types.h>

#include "commands.h"

typedef struct background {
    pid_t pid;
    int err; /* what it says on stderr comes from here; its stdout is lost */
} background;

/* Start octreel with the arguments that a format gives, in a process group of its own. */
background start_octreel(const char *format, ...);

/* Wait until there is a file of this name. False when octreel ends without it, and after half a minute. */
bool file_comes(const background *b, const char *path);

/* The same; the test fails where that is false. */
void wait_for_file(background *b, const char *path);

/* A child of a process, the place-th of those that there are; 0 when there are no more, or no /proc to ask. */
pid_t child_of(pid_t parent, unsigned place);

/* Wait for its end. Of the result, `out` is empty. */
command_result end_of(background *b);

#endif
