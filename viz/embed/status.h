/* SPDX-License-Identifier: MIT */
/* status.h - statuses with their sentences. Private to this folder. */
#ifndef EMBED_STATUS_H
#define EMBED_STATUS_H

#include "octreel/recorder.h"

/* Write a sentence for a status, and return it. */
octreel_status status_refuse(octreel_error *error, octreel_status status, const char *format, ...);

/* The same with the status's own. */
octreel_status status_fail(octreel_error *error, octreel_status status);

#endif
