/* SPDX-License-Identifier: MIT */
/* status.h - statuses with error texts. Private to this folder. */
#ifndef EMBED_STATUS_H
#define EMBED_STATUS_H

#include "octreel/recorder.h"

/* Write an error text and return the status. */
octreel_status status_refuse(octreel_error *error, octreel_status status, const char *format, ...);

/* Write the status's own text and return the status. */
octreel_status status_fail(octreel_error *error, octreel_status status);

#endif
