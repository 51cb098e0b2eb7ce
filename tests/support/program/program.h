/* SPDX-License-Identifier: MIT */
/* program.h - the common parts of the programs bench, campaign and tradeoff: error messages with status 2, and parsing
 * of arguments. */
#ifndef PROGRAM_H
#define PROGRAM_H

#include <stdlib.h>

enum { EXIT_DONE = 0, EXIT_FINDING = 1, EXIT_TROUBLE = 2 };

/* Each program defines its name; messages begin with it. */
extern const char program_name[];

/* Print a message to standard error and exit with EXIT_TROUBLE. */
_Noreturn void stop(const char *format, ...);

/* realloc(), or stop() if there is no memory. */
void *memory(void *old, size_t size);

/* Parse a whole number from `least` to `most`, both below 2^53; 1e6 is allowed. Otherwise stop(). */
double take_whole(const char *option, const char *text, double least, double most);

/* Parse one entry of a list, or stop(). */
typedef void take_entry(void *options, const char *entry);

/* Parse each entry of a list with commas; the text is cut in place. */
void take_list(void *options, char *list, take_entry *take);

/* Exit with a status, or stop() if standard output could not be written. */
_Noreturn void finish(int status);

#endif
