/* SPDX-License-Identifier: MIT */
#include "pool.h"
#include "bits.h"

#include <stdlib.h>
#include <string.h>

#define SLAB_MIN_BYTES 4096
#define SLAB_MAX_BYTES (1u << 22)
#define CACHE_LINE 64

/* The header is followed by one bit per unit, used while free blocks are joined, and then by the units. */
struct slab {
    struct slab *next;
    size_t size; /* bytes in all */
    size_t units;
    unsigned char *first; /* unit, at the start of a cache line */
};

struct free_block {
    struct free_block *next;
};

static void *default_allocate(size_t size, void *context)
{
    (void)context;
    return malloc(size);
}

static void default_release(void *memory, size_t size, void *context)
{
    (void)size;
    (void)context;
    free(memory);
}

octree_allocator default_allocator(void)
{
    return (octree_allocator){.allocate = default_allocate, .release = default_release};
}

void *arena_take(arena *a, size_t size)
{
    void *memory = a->allocator.allocate(size, a->allocator.context);
    if (memory)
        a->bytes += size;
    return memory;
}

void arena_give(arena *a, void *memory, size_t size)
{
    if (!memory)
        return;
    a->bytes -= size;
    a->allocator.release(memory, size, a->allocator.context);
}

void pool_init(pool *p, arena *memory, size_t unit)
{
    *p = (pool){.memory = memory, .unit = unit};
}

void pool_release(pool *p)
{
    for (struct slab *slab = p->slabs; slab;) {
        struct slab *next = slab->next;
        arena_give(p->memory, slab, slab->size);
        slab = next;
    }
    pool_init(p, p->memory, p->unit);
}

static void push(pool *p, void *block, unsigned units)
{
    if (units == 0)
        return;
    struct free_block *freed = block;
    freed->next = p->free_blocks[units - 1];
    p->free_blocks[units - 1] = freed;
    p->available |= UINT64_C(1) << (units - 1);
    p->free_units += units;
}

static void *pop(pool *p, unsigned units)
{
    struct free_block *block = p->free_blocks[units - 1];
    p->free_blocks[units - 1] = block->next;
    if (!block->next)
        p->available &= ~(UINT64_C(1) << (units - 1));
    p->free_units -= units;
    return block;
}

void pool_give(pool *p, void *block, unsigned units)
{
    p->freed_units += units;
    push(p, block, units);
}

static uint64_t *bits_of(struct slab *slab)
{
    return (uint64_t *)(slab + 1);
}

static size_t words_for(size_t units)
{
    return (units + 63) / 64;
}

static bool lies_in(const pool *p, const struct slab *slab, const void *block)
{
    const uintptr_t first = (uintptr_t)slab->first, at = (uintptr_t)block;
    return at >= first && at - first < slab->units * p->unit;
}

/* The slab that a block lies in: most often that of the block before it. */
static struct slab *slab_of(const pool *p, const void *block, struct slab *guess)
{
    struct slab *slab = lies_in(p, guess, block) ? guess : p->slabs;
    while (!lies_in(p, slab, block))
        slab = slab->next;
    return slab;
}

static void mark_free(pool *p)
{
    struct slab *slab = p->slabs;
    for (unsigned units = 1; units <= POOL_MAX_UNITS; units++) {
        while (p->free_blocks[units - 1]) {
            const unsigned char *block = pop(p, units);
            slab = slab_of(p, block, slab);
            const size_t start = (size_t)(block - slab->first) / p->unit;
            for (size_t unit = start; unit < start + units; unit++)
                bits_of(slab)[unit / 64] |= UINT64_C(1) << unit % 64;
        }
    }
}

static bool is_free(struct slab *slab, size_t unit)
{
    return unit < slab->units && bits_of(slab)[unit / 64] >> unit % 64 & 1;
}

/* Put the free runs of a slab into the free lists, in blocks of at most POOL_MAX_UNITS. */
static void push_runs(pool *p, struct slab *slab)
{
    for (size_t unit = 0; unit < slab->units; unit++) {
        unsigned run = 0;
        while (run < POOL_MAX_UNITS && is_free(slab, unit + run))
            run++;
        push(p, slab->first + unit * p->unit, run);
        unit += run ? run - 1 : 0;
    }
}

/* Join adjacent free blocks. */
static void join_free_blocks(pool *p)
{
    for (struct slab *slab = p->slabs; slab; slab = slab->next)
        memset(bits_of(slab), 0, words_for(slab->units) * sizeof(uint64_t));
    mark_free(p);
    for (struct slab *slab = p->slabs; slab; slab = slab->next)
        push_runs(p, slab);
    p->freed_units = 0;
}

/* An eighth of the pool's size, so that at most an eighth is unused. */
static size_t next_slab_bytes(const pool *p)
{
    const size_t eighth = p->total_units * p->unit / 8;
    if (eighth < SLAB_MIN_BYTES)
        return SLAB_MIN_BYTES;
    return eighth < SLAB_MAX_BYTES ? eighth : SLAB_MAX_BYTES;
}

static bool add_slab(pool *p)
{
    const size_t units = next_slab_bytes(p) / p->unit;
    const size_t header = sizeof(struct slab) + words_for(units) * sizeof(uint64_t);
    const size_t size = header + CACHE_LINE + units * p->unit;
    struct slab *slab = arena_take(p->memory, size);
    if (!slab)
        return false;
    push(p, p->fresh, (unsigned)p->fresh_units); /* fewer than POOL_MAX_UNITS, or no slab would be needed */
    const uintptr_t end_of_header = (uintptr_t)slab + header;
    const size_t skip = (size_t)(-end_of_header & (CACHE_LINE - 1));
    *slab =
        (struct slab){.next = p->slabs, .size = size, .units = units, .first = (unsigned char *)slab + header + skip};
    p->slabs = slab;
    p->fresh = slab->first;
    p->fresh_units = units;
    p->total_units += units;
    return true;
}

static void *take_free(pool *p, unsigned units)
{
    const uint64_t large_enough = p->available >> (units - 1) << (units - 1);
    if (!large_enough)
        return NULL;
    const unsigned found = bits_lowest(large_enough) + 1;
    unsigned char *block = pop(p, found);
    push(p, block + units * p->unit, found - units);
    return block;
}

/* Joining costs time in proportion to what is free. It is done when an eighth of the pool is free and half of that was
 * freed since the last time, so that its amortized cost per freed block is constant. */
static bool worth_joining(const pool *p)
{
    return p->free_units > p->total_units / 8 && p->freed_units > p->free_units / 2;
}

void *pool_take(pool *p, unsigned units)
{
    void *block = take_free(p, units);
    if (!block && p->fresh_units < units && worth_joining(p)) {
        join_free_blocks(p);
        block = take_free(p, units);
    }
    if (block)
        return block;
    if (p->fresh_units < units && !add_slab(p))
        return NULL;
    block = p->fresh;
    p->fresh += units * p->unit;
    p->fresh_units -= units;
    return block;
}

void *list_append(arena *memory, list *l, size_t item_size)
{
    if (l->count == l->room) {
        const size_t room = l->room ? 2 * l->room : 16;
        void *items = room <= SIZE_MAX / item_size ? arena_take(memory, room * item_size) : NULL;
        if (!items)
            return NULL;
        if (l->count)
            memcpy(items, l->items, l->count * item_size);
        arena_give(memory, l->items, l->room * item_size);
        l->items = items;
        l->room = room;
    }
    return (unsigned char *)l->items + l->count++ * item_size;
}

void list_release(arena *memory, list *l, size_t item_size)
{
    arena_give(memory, l->items, l->room * item_size);
    *l = (list){0};
}
