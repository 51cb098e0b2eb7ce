/* SPDX-License-Identifier: MIT */
/* error.h - writes error messages, and detects failures whose cause is a lack of system resources. */
#ifndef BASE_ERROR_H
#define BASE_ERROR_H

#include "octreel/error.h"

#include <stdbool.h>

/* Writes an error message from a printf format. Always returns false, so that the caller can write `return
 * error_set(...)`. */
bool error_set(octreel_error *error, const char *format, ...);

/* Writes the error "out of memory". Always returns false. */
bool error_no_memory(octreel_error *error);

/* Looks at errno after a check that failed. Returns false with an error if errno says that the system ran out of
 * memory, file descriptors or disk space, or failed to read. Such a failure proves nothing about the input of the
 * check. Returns true for other values of errno, such as ENOENT or EACCES. The caller sets errno to 0 before the
 * check. */
bool check_system_resources(octreel_error *error);

#endif
