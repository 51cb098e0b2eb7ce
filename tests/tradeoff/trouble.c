/* trouble.c - see trouble.h. */
#include "trouble.h"

#include <stdarg.h>
#include <stdio.h>

_Noreturn void stop(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("octree-tradeoff: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(2);
}

void *memory(void *old, size_t size)
{
    void *new = realloc(old, size > 0 ? size : 1);
    if (!new)
        stop("there is no memory");
    return new;
}

void must(octree_status status)
{
    if (status != OCTREE_OK)
        stop("the library refuses: %s", octree_status_text(status));
}
