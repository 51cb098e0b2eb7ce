/* SPDX-License-Identifier: MIT */
/* error.h - the sentences of errors. */
#ifndef BASE_ERROR_H
#define BASE_ERROR_H

#include "octreel/error.h"

#include <stdbool.h>

/* Write a sentence, a printf format; always false, so that a caller can return it. */
bool error_set(octreel_error *error, const char *format, ...);

/* The same for lack of memory. */
bool error_no_memory(octreel_error *error);

/* False, with a sentence, where the last call that failed had no memory or no file that can be read, be it ours,
 * libpng's, jansson's or the C library's: then what was found wrong may be right. A file that is missing or that may
 * not be read is no such trouble. Set errno to 0 before what is asked about. */
bool check_system_resources(octreel_error *error);

#endif
