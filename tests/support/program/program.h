/* SPDX-License-Identifier: MIT */
/* program.h - what the benches, the campaign and the trade-off have in common as commands: a sentence and status 2 for
 * what cannot be done, and the reading of arguments.
 */
#ifndef PROGRAM_H
#define PROGRAM_H

#include <stdlib.h>

enum { EXIT_DONE = 0, EXIT_FINDING = 1, EXIT_TROUBLE = 2 };

/* Each program says its own name, which sentences begin with. */
extern const char program_name[];

/* Say why on standard error and end with EXIT_TROUBLE. */
_Noreturn void stop(const char *format, ...);

/* As realloc, or stop. */
void *memory(void *old, size_t size);

/* A whole number from least to most, which are below 2^53, also as in 1e6; or stop. */
double take_whole(const char *option, const char *text, double least, double most);

/* Take in one entry of a list, or stop. */
typedef void take_entry(void *options, const char *entry);

/* Take in what stands between the commas of a list, which is cut in place. */
void take_list(void *options, char *list, take_entry *take);

/* End with a status, or stop if standard output could not be written. */
_Noreturn void finish(int status);

#endif
