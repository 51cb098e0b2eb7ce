/* SPDX-License-Identifier: MIT */
/* error.h - writes error messages and recognizes errors of the system. */
#ifndef BASE_ERROR_H
#define BASE_ERROR_H

#include "octreel/error.h"

#include <stdbool.h>

/* Write an error message with a printf format. Always returns false, so that a caller can return the result. */
bool error_set(octreel_error *error, const char *format, ...);

/* Write "out of memory". Always returns false. */
bool error_no_memory(octreel_error *error);

/* Returns false, with an error, if errno says that the system ran out of memory, files or disk space, or failed to
 * read. A check that failed for such a reason says nothing about its input, which may be correct. Missing files and
 * missing permissions are not such reasons. Set errno to 0 before the check. */
bool check_system_resources(octreel_error *error);

#endif
