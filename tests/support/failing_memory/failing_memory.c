/* SPDX-License-Identifier: MIT */
#include "failing_memory.h"

#include <limits.h>
#include <stdatomic.h>
#include <stddef.h>

#define NEVER LONG_MAX

static _Thread_local long left = -1;
static _Thread_local bool failed, is_here;
static bool alone;
static atomic_long left_elsewhere = NEVER; /* below 0 it has failed */

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);

void fail_allocations_after(long count)
{
    left = count;
    failed = false;
}

void fail_one_allocation(void)
{
    alone = true;
}

bool memory_has_failed(void)
{
    left = -1;
    return failed;
}

void fail_allocations_elsewhere_after(long count)
{
    is_here = true;
    atomic_store(&left_elsewhere, count);
}

bool memory_has_failed_elsewhere(void)
{
    return atomic_exchange(&left_elsewhere, NEVER) < 0;
}

static bool is_refused(void)
{
    if (!is_here && atomic_load(&left_elsewhere) != NEVER)
        return atomic_fetch_sub(&left_elsewhere, 1) == 0;
    if (left > 0)
        left--;
    else if (left == 0 && !(alone && failed))
        return failed = true;
    return false;
}

void *__wrap_malloc(size_t size)
{
    return is_refused() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    return is_refused() ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *memory, size_t size)
{
    return is_refused() ? NULL : __real_realloc(memory, size);
}
