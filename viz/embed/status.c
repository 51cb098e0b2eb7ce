/* SPDX-License-Identifier: MIT */
/* status.c - writes an error text and returns a status: see status.h. */
#include "status.h"

#include <stdarg.h>
#include <stdio.h>

const char *octreel_status_text(octreel_status status)
{
#define OCTREEL_STATUS_TEXT(name, text) text,
    static const char *const texts[OCTREEL_STATUS_COUNT] = {OCTREEL_STATUS_MAP(OCTREEL_STATUS_TEXT)};
#undef OCTREEL_STATUS_TEXT
    return (unsigned)status < OCTREEL_STATUS_COUNT ? texts[status] : "unknown status";
}

octreel_status status_refuse(octreel_error *error, octreel_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    return status;
}

octreel_status status_fail(octreel_error *error, octreel_status status)
{
    return status_refuse(error, status, "%s", octreel_status_text(status));
}
