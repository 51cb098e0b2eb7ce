/* SPDX-License-Identifier: MIT */
#include "heap_peak.h"

#include <malloc.h>

/* Below zero where more is given back than was taken here: what a shared library took. */
static ptrdiff_t bytes, before, most;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void __wrap_free(void *memory);

void heap_peak_begin(void)
{
    before = most = bytes;
}

size_t heap_peak(void)
{
    return (size_t)(most - before);
}

static void *count(void *memory)
{
    bytes += (ptrdiff_t)malloc_usable_size(memory);
    most = bytes > most ? bytes : most;
    return memory;
}

void *__wrap_malloc(size_t size)
{
    return count(__real_malloc(size));
}

void *__wrap_calloc(size_t items, size_t size)
{
    return count(__real_calloc(items, size));
}

void *__wrap_realloc(void *memory, size_t size)
{
    const ptrdiff_t old = (ptrdiff_t)malloc_usable_size(memory);
    void *grown = __real_realloc(memory, size);
    bytes -= grown ? old : 0;
    return grown ? count(grown) : NULL;
}

void __wrap_free(void *memory)
{
    bytes -= (ptrdiff_t)malloc_usable_size(memory);
    __real_free(memory);
}
