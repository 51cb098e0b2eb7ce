/* SPDX-License-Identifier: MIT */
/* error.h - writes error messages, and recognizes errors that are caused by lack of system resources. */
#ifndef BASE_ERROR_H
#define BASE_ERROR_H

#include "octreel/error.h"

#include <stdbool.h>

/* Writes an error message from a printf format. Always returns false, so that a caller can return the result. */
bool error_set(octreel_error *error, const char *format, ...);

/* Writes the error "out of memory". Always returns false. */
bool error_no_memory(octreel_error *error);

/* Returns false with an error if errno says that the system ran out of memory, files or disk space, or failed to
 * read. A check that failed for such a reason proves nothing about its input, which may be correct. For a missing
 * file or a missing permission, returns true. The caller sets errno to 0 before the check. */
bool check_system_resources(octreel_error *error);

#endif
