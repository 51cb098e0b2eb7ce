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

#endif
