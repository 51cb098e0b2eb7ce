/* SPDX-License-Identifier: MIT */
#include "heap_peak.h"

#include <malloc.h>
#include <stdatomic.h>

/* By the names that glibc gives its own; or as the linker leads the program's calls here. */
#ifdef HEAP_PEAK_GLIBC
#define OURS(name) name
#define REAL(name) __libc_##name
#else
#define OURS(name) __wrap_##name
#define REAL(name) __real_##name
#endif

/* Below zero where more is given back than was taken here: what came from other functions. */
static _Atomic ptrdiff_t bytes, most;
static ptrdiff_t before;

void *REAL(malloc)(size_t size);
void *REAL(calloc)(size_t count, size_t size);
void *REAL(realloc)(void *memory, size_t size);
void REAL(free)(void *memory);
void *OURS(malloc)(size_t size);
void *OURS(calloc)(size_t count, size_t size);
void *OURS(realloc)(void *memory, size_t size);
void OURS(free)(void *memory);

void heap_peak_begin(void)
{
    before = atomic_load(&bytes);
    atomic_store(&most, before);
}

size_t heap_peak(void)
{
    return (size_t)(atomic_load(&most) - before);
}

static void *count(void *memory)
{
    const ptrdiff_t more = (ptrdiff_t)malloc_usable_size(memory), now = atomic_fetch_add(&bytes, more) + more;
    if (now > atomic_load(&most))
        atomic_store(&most, now);
    return memory;
}

void *OURS(malloc)(size_t size)
{
    return count(REAL(malloc)(size));
}

void *OURS(calloc)(size_t items, size_t size)
{
    return count(REAL(calloc)(items, size));
}

void *OURS(realloc)(void *memory, size_t size)
{
    const ptrdiff_t old = (ptrdiff_t)malloc_usable_size(memory);
    void *grown = REAL(realloc)(memory, size);
    atomic_fetch_sub(&bytes, grown ? old : 0);
    return grown ? count(grown) : NULL;
}

void OURS(free)(void *memory)
{
    atomic_fetch_sub(&bytes, (ptrdiff_t)malloc_usable_size(memory));
    REAL(free)(memory);
}
