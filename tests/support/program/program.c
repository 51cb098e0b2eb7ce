/* SPDX-License-Identifier: MIT */
/* program.c - see program.h. */
#include "program.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Noreturn void stop(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "%s: ", program_name);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(EXIT_TROUBLE);
}

void *memory(void *old, size_t size)
{
    void *new = realloc(old, size > 0 ? size : 1);
    if (!new)
        stop("there is no memory");
    return new;
}

double take_whole(const char *option, const char *text, double least, double most)
{
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end || !(value >= least && value <= most) || value != floor(value))
        stop("%s takes a whole number from %.15g to %.15g, not \"%s\"", option, least, most, text);
    return value;
}

void take_list(void *options, char *list, take_entry *take)
{
    for (char *entry = list; entry;) {
        char *comma = strchr(entry, ',');
        if (comma)
            *comma = 0;
        take(options, entry);
        entry = comma ? comma + 1 : NULL;
    }
}

_Noreturn void finish(int status)
{
    if (fflush(stdout) != 0 || ferror(stdout))
        stop("the results cannot be written to standard output");
    exit(status);
}
