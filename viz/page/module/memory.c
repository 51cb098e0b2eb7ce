/* SPDX-License-Identifier: MIT */
/* memory.c - an sbrk() that stores the end of the used memory in that memory itself.
 *
 * The page returns to an earlier state of the game by copying the memory back. But the memory of WebAssembly never
 * shrinks, and the sbrk() of wasi-libc assumes that all of it is in use. So each return to an earlier state would leak
 * all memory that was allocated since that state. Here the end of the used memory is part of the state. Returning to a
 * state restores this end, and the memory behind it is used again. */
#include <stddef.h>
#include <stdint.h>
#include <unistd.h>

#define MEMORY_PAGE ((size_t)65536)

static size_t end;

static size_t memory_size(void)
{
    return (size_t)__builtin_wasm_memory_size(0) * MEMORY_PAGE;
}

/* Returns the number of bytes, counted from address 0, that contain the module's state. Before the first call of sbrk()
 * this is the whole memory, because newer versions of wasi-libc use the memory behind the static data without calling
 * sbrk(). */
size_t web_used(void)
{
    return end ? end : memory_size();
}

void *sbrk(intptr_t more)
{
    const size_t before = web_used(), wanted = before + (size_t)more;
    const size_t size = memory_size();
    if (more < 0 || wanted < before ||
        (wanted > size && __builtin_wasm_memory_grow(0, (wanted - size + MEMORY_PAGE - 1) / MEMORY_PAGE) == (size_t)-1))
        return (void *)-1;
    end = wanted;
    return (void *)before;
}
