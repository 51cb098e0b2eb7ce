/* SPDX-License-Identifier: MIT */
/* completion.h - writes completion scripts for shells. */
#ifndef CLI_COMPLETION_H
#define CLI_COMPLETION_H

#include <stdbool.h>
#include <stdio.h>

/* Returns the name of the n-th supported shell; null: n is beyond the last. */
const char *completion_shell(int n);

/* Write the completion script of a shell. False: the shell is not supported. */
bool completion_write(FILE *out, const char *shell);

#endif
