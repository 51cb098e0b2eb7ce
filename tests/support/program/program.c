/* SPDX-License-Identifier: MIT */
/* program.c - see program.h. */
#include "program.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Noreturn void stop_with_error(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "%s: ", program_name);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(EXIT_TROUBLE);
}

void *resize_memory(void *old, size_t size)
{
    void *new = realloc(old, size > 0 ? size : 1);
    if (!new)
        stop_with_error("out of memory");
    return new;
}

double parse_whole_number(const char *option, const char *text, double least, double most)
{
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end || !(value >= least && value <= most) || value != floor(value))
        stop_with_error("%s takes a whole number from %.15g to %.15g, not \"%s\"", option, least, most, text);
    return value;
}

void parse_list(void *options, char *list, parse_entry *take)
{
    for (char *entry = list; entry;) {
        char *comma = strchr(entry, ',');
        if (comma)
            *comma = 0;
        take(options, entry);
        entry = comma ? comma + 1 : NULL;
    }
}

_Noreturn void exit_with_status(int status)
{
    if (fflush(stdout) != 0 || ferror(stdout))
        stop_with_error("cannot write the results to standard output");
    exit(status);
}
