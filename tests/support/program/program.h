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
_Noreturn void stop_with_error(const char *format, ...);

/* realloc(), or stop_with_error() if there is no memory. */
void *resize_memory(void *old, size_t size);

/* Parse a whole number from `least` to `most`, both below 2^53; 1e6 is allowed. Otherwise stop_with_error(). */
double parse_whole_number(const char *option, const char *text, double least, double most);

/* Parse one entry of a list, or stop_with_error(). */
typedef void parse_entry(void *options, const char *entry);

/* Parse each entry of a list with commas; the text is cut in place. */
void parse_list(void *options, char *list, parse_entry *take);

/* Exit with a status, or stop_with_error() if standard output could not be written. */
_Noreturn void exit_with_status(int status);

#endif
