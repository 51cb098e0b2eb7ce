/* SPDX-License-Identifier: MIT */
/* completion.h - how shells complete a command line of octreel's, from the tables by which it is read. */
#ifndef CLI_COMPLETION_H
#define CLI_COMPLETION_H

#include <stdbool.h>
#include <stdio.h>

/* The n-th shell that has completions; null beyond the last. */
const char *completion_shell(int n);

/* Write the file of completions of a shell; false where it is none of these. */
bool completion_write(FILE *out, const char *shell);

#endif
