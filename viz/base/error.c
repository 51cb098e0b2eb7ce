/* SPDX-License-Identifier: MIT */
/* error.c - writes error messages. */
#include "error.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* A message begins with a path and ends with a reason. A message that is too long loses its beginning, so that the
 * reason stays complete. */
bool error_set(octreel_error *error, const char *format, ...)
{
    char whole[PATH_MAX + sizeof error->text];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(whole, sizeof whole, format, arguments);
    va_end(arguments);
    const size_t length = strlen(whole), room = sizeof error->text - 1;
    const size_t left_out = length > room ? length - room : 0;
    memcpy(error->text, whole + left_out, length - left_out + 1);
    if (left_out)
        memcpy(error->text, "...", 3);
    return false;
}

bool error_no_memory(octreel_error *error)
{
    return error_set(error, "out of memory");
}

bool check_system_resources(octreel_error *error)
{
    static const int resource_errors[] = {EIO, EMFILE, ENFILE, ENOSPC, EDQUOT, EINTR};
    if (errno == ENOMEM)
        return error_no_memory(error);
    for (size_t i = 0; i < sizeof resource_errors / sizeof *resource_errors; i++)
        if (errno == resource_errors[i])
            return error_set(error, "a file cannot be read: %s", strerror(errno));
    return true;
}
