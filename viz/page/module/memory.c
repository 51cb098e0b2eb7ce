/* SPDX-License-Identifier: MIT */
/* memory.c - the end of the memory in use, kept in that memory: a page that returns to an earlier state of it returns
 * to an earlier end, and what was got from the browser since then is used again. In place of wasi-libc's sbrk(), which
 * would ask the browser for more. */
#include <stddef.h>
#include <stdint.h>
#include <unistd.h>

#define BROWSER_PAGE ((size_t)65536)

static size_t end;

static size_t bytes_there(void)
{
    return (size_t)__builtin_wasm_memory_size(0) * BROWSER_PAGE;
}

/* The bytes from 0 on that hold the module's state: at first all that it began with, since newer versions of
 * wasi-libc take what lies behind the data there without asking. */
size_t web_used(void)
{
    return end ? end : bytes_there();
}

void *sbrk(intptr_t more)
{
    const size_t before = web_used(), wanted = before + (size_t)more;
    const size_t there = bytes_there();
    if (more < 0 || wanted < before ||
        (wanted > there &&
         __builtin_wasm_memory_grow(0, (wanted - there + BROWSER_PAGE - 1) / BROWSER_PAGE) == (size_t)-1))
        return (void *)-1;
    end = wanted;
    return (void *)before;
}
