/* SPDX-License-Identifier: MIT */
/* memory.c - sbrk() that keeps the end of the used memory in that memory itself.
 *
 * The page goes back to an earlier state by copying the memory back, but WebAssembly's memory never shrinks.
 * wasi-libc's sbrk() assumes that all memory up to its size is used, so each return to an earlier state would leak
 * all memory that was allocated since. Here the end of the used memory is restored with the rest, and the memory behind
 * it is used again. */
#include <stddef.h>
#include <stdint.h>
#include <unistd.h>

#define MEMORY_PAGE ((size_t)65536)

static size_t end;

static size_t memory_size(void)
{
    return (size_t)__builtin_wasm_memory_size(0) * MEMORY_PAGE;
}

/* The number of bytes from address 0 that hold the module's state. At first that is the whole memory, since newer
 * versions of wasi-libc use the part behind the static data without calling sbrk(). */
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
