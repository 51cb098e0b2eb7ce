/* SPDX-License-Identifier: MIT */
/* status.h - functions that write an error text and return a status. Private to viz/embed. */
#ifndef EMBED_STATUS_H
#define EMBED_STATUS_H

#include "octreel/recorder.h"

/* Write a formatted error text and return the status. */
octreel_status status_refuse(octreel_error *error, octreel_status status, const char *format, ...);

/* Write the status's own text, octreel_status_text(), as the error and return the status. */
octreel_status status_fail(octreel_error *error, octreel_status status);

#endif
