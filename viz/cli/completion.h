/* SPDX-License-Identifier: MIT */
/* completion.h - writes completion scripts for shells. */
#ifndef CLI_COMPLETION_H
#define CLI_COMPLETION_H

#include <stdbool.h>
#include <stdio.h>

/* Returns the name of the n-th supported shell; null if n is beyond the last. */
const char *completion_shell_name(int n);

/* Writes the completion script of a shell. Returns false if the shell is not supported. */
bool completion_write(FILE *out, const char *shell);

#endif
