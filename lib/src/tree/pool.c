/* SPDX-License-Identifier: MIT */
/* pool.c - the pool allocator of a tree.
 *
 * Problem: a tree allocates and frees many small blocks of 1 to 64 units, in any order. malloc adds a header and
 * alignment to each.
 *
 * Idea: slabs of units, and one free list per block size. A block is taken from the free list of its size, from a
 * larger free block that is split, or from the unused end of the newest slab. A freed block only enters a list, which
 * takes a few instructions.
 *
 * When more than an eighth of the pool is free, and more than half of the free units were freed since the last joining,
 * adjacent free blocks are joined. All free units are marked in bit maps, and the runs of marked units become the new
 * free lists. Buddy allocation would waste up to half of each block. Joining costs O(pool), which is amortized over the
 * blocks that were freed since the last joining.
 *
 * Each task has pools of its own. While the tree's pool has much free memory, the pools of tasks borrow blocks from it
 * under a lock.
 */
#include "pool.h"
#include "../exact/bits.h"
#include "../exact/float_mode.h"

#include <stdlib.h>
#include <string.h>

#define SLAB_MIN_BYTES 4096
#define SLAB_MAX_BYTES (1u << 22)
#define CACHE_LINE 64

/* The header of a slab. After the header comes a bit map with one bit per unit, which marks the free units while blocks
 * are joined. After the bit map come the units. */
struct slab {
    struct slab *next;
    size_t size; /* the size of the whole slab in bytes */
    size_t units;
    unsigned char *first; /* the first unit, aligned to a cache line */
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

/* Returns the arena that counts the allocated bytes. Locks this arena if tasks share it. */
static arena *lock_counting_arena(arena *a)
{
    if (a->shared)
        arena_lock(a->shared);
    return a->shared ? a->shared : a;
}

static void unlock_counting_arena(arena *a)
{
    if (a->shared)
        arena_unlock(a->shared);
}

void *arena_allocate(arena *a, size_t size)
{
    arena *owner = lock_counting_arena(a);
    const bool paused = float_mode_pause();
    void *memory = owner->allocator.allocate(size, owner->allocator.context);
    float_mode_resume(paused);
    owner->bytes += memory ? size : 0;
    unlock_counting_arena(a);
    return memory;
}

void arena_free(arena *a, void *memory, size_t size)
{
    if (!memory)
        return;
    arena *owner = lock_counting_arena(a);
    owner->bytes -= size;
    const bool paused = float_mode_pause();
    owner->allocator.release(memory, size, owner->allocator.context);
    float_mode_resume(paused);
    unlock_counting_arena(a);
}

void pool_init(pool *p, arena *memory, size_t unit)
{
    *p = (pool){.memory = memory, .unit = unit};
}

void pool_release(pool *p)
{
    for (struct slab *slab = p->slabs; slab;) {
        struct slab *next = slab->next;
        arena_free(p->memory, slab, slab->size);
        slab = next;
    }
    pool_init(p, p->memory, p->unit);
}

static void add_free_block(pool *p, void *block, unsigned units)
{
    if (units == 0)
        return;
    struct free_block *freed = block;
    freed->next = p->free_blocks[units - 1];
    if (!freed->next)
        p->last_free[units - 1] = freed;
    p->free_blocks[units - 1] = freed;
    p->available |= UINT64_C(1) << (units - 1);
    p->free_units += units;
}

static void *remove_first_free_block(pool *p, unsigned units)
{
    struct free_block *block = p->free_blocks[units - 1];
    p->free_blocks[units - 1] = block->next;
    if (!block->next)
        p->available &= ~(UINT64_C(1) << (units - 1));
    p->free_units -= units;
    return block;
}

void pool_free(pool *p, void *block, unsigned units)
{
    p->freed_units += units;
    add_free_block(p, block, units);
}

static uint64_t *bit_map_of_slab(struct slab *slab)
{
    return (uint64_t *)(slab + 1);
}

static size_t count_bit_map_words(size_t units)
{
    return (units + 63) / 64;
}

static bool is_in_slab(const pool *p, const struct slab *slab, const void *block)
{
    const uintptr_t first = (uintptr_t)slab->first, at = (uintptr_t)block;
    return at >= first && at - first < slab->units * p->unit;
}

static int compare_slabs(const void *a, const void *b)
{
    const uintptr_t p = (uintptr_t) * (struct slab *const *)a, q = (uintptr_t) * (struct slab *const *)b;
    return (p > q) - (p < q);
}

enum { FEW_SLABS = 64 };

/* Returns an array of all slabs, sorted by address. Returns null if there are few slabs or if memory runs out. */
static struct slab **sort_slabs(pool *p)
{
    struct slab **sorted = p->slab_count > FEW_SLABS ? arena_allocate(p->memory, p->slab_count * sizeof *sorted) : NULL;
    size_t count = 0;
    for (struct slab *slab = p->slabs; sorted && slab; slab = slab->next)
        sorted[count++] = slab;
    if (sorted)
        qsort(sorted, count, sizeof *sorted, compare_slabs);
    return sorted;
}

/* Returns the slab that contains a block. `guess` is the slab of the previous block, which is usually the same slab. */
static struct slab *find_slab(const pool *p, struct slab **sorted, const void *block, struct slab *guess)
{
    if (is_in_slab(p, guess, block))
        return guess;
    if (!sorted) {
        struct slab *slab = p->slabs;
        while (!is_in_slab(p, slab, block))
            slab = slab->next;
        return slab;
    }
    /* invariant: the index of the last slab that begins before the block is in [low, high) */
    size_t low = 0, high = p->slab_count;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if ((uintptr_t)sorted[middle] <= (uintptr_t)block)
            low = middle;
        else
            high = middle;
    }
    return sorted[low];
}

/* Set the bits of `units` adjacent units, at most POOL_MAX_UNITS. */
static void mark_units(uint64_t *bits, size_t first, unsigned units)
{
    const uint64_t mask = UINT64_MAX >> (POOL_MAX_UNITS - units);
    const unsigned shift = first % 64;
    bits[first / 64] |= mask << shift;
    if (shift + units > 64)
        bits[first / 64 + 1] |= mask >> (64 - shift);
}

static void mark_free_blocks(pool *p, struct slab **sorted)
{
    struct slab *slab = p->slabs;
    for (unsigned units = 1; units <= POOL_MAX_UNITS; units++)
        while (p->free_blocks[units - 1]) {
            const unsigned char *block = remove_first_free_block(p, units);
            slab = find_slab(p, sorted, block, slab);
            mark_units(bit_map_of_slab(slab), (size_t)(block - slab->first) / p->unit, units);
        }
}

/* Returns the bits of 64 units from `unit` on. Bits beyond the last unit are 0. */
static uint64_t load_mark_bits(struct slab *slab, size_t unit)
{
    const uint64_t *bits = bit_map_of_slab(slab) + unit / 64;
    const unsigned shift = unit % 64;
    const bool more = shift > 0 && unit / 64 + 1 < count_bit_map_words(slab->units);
    return bits[0] >> shift | (more ? bits[1] << (64 - shift) : 0);
}

/* Add each run of free units to the free lists, in blocks of at most POOL_MAX_UNITS. The bits of free units are set. */
static void add_free_runs(pool *p, struct slab *slab)
{
    for (size_t unit = 0; unit < slab->units;) {
        const uint64_t marks = load_mark_bits(slab, unit);
        const unsigned used = marks ? bits_lowest(marks) : 64;
        const unsigned run = used ? 0 : ~marks ? bits_lowest(~marks) : POOL_MAX_UNITS;
        add_free_block(p, slab->first + unit * p->unit, run);
        unit += used + run;
    }
}

/* Make new free lists, in which adjacent free blocks are joined to larger blocks. */
static void join_free_blocks(pool *p)
{
    struct slab **sorted = sort_slabs(p);
    for (struct slab *slab = p->slabs; slab; slab = slab->next)
        memset(bit_map_of_slab(slab), 0, count_bit_map_words(slab->units) * sizeof(uint64_t));
    mark_free_blocks(p, sorted);
    for (struct slab *slab = p->slabs; slab; slab = slab->next)
        add_free_runs(p, slab);
    p->freed_units = 0;
    arena_free(p->memory, sorted, p->slab_count * sizeof *sorted);
}

/* Returns the size of the next slab in bytes. The first slabs have room for the expected units. A further slab is as
 * large as an eighth of the pool, or a thirty-second if a number of units was expected. So at most this part of the
 * pool is unused. */
static size_t next_slab_bytes(const pool *p)
{
    const size_t least = p->lender ? POOL_MAX_UNITS * p->unit : SLAB_MIN_BYTES;
    const size_t more = p->total_units / (p->expected ? 32 : 8);
    const size_t rest = p->expected > p->total_units ? p->expected - p->total_units : 0;
    const size_t wanted = (rest > more ? rest : more) * p->unit;
    const size_t most = p->lender && p->total_units == 0 ? SIZE_MAX : SLAB_MAX_BYTES;
    return wanted < least ? least : wanted < most ? wanted : most;
}

static bool add_slab(pool *p)
{
    const size_t units = next_slab_bytes(p) / p->unit;
    const size_t header = sizeof(struct slab) + count_bit_map_words(units) * sizeof(uint64_t);
    const size_t size = header + CACHE_LINE + units * p->unit;
    struct slab *slab = arena_allocate(p->memory, size);
    if (!slab)
        return false;
    /* Fewer than POOL_MAX_UNITS units of the newest slab are unused; with more unused units, no new slab would be
     * needed. */
    add_free_block(p, p->fresh, (unsigned)p->fresh_units);
    const uintptr_t end_of_header = (uintptr_t)slab + header;
    const size_t skip = (size_t)(-end_of_header & (CACHE_LINE - 1));
    *slab =
        (struct slab){.next = p->slabs, .size = size, .units = units, .first = (unsigned char *)slab + header + skip};
    p->slabs = slab;
    p->slab_count++;
    p->fresh = slab->first;
    p->fresh_units = units;
    p->total_units += units;
    return true;
}

static void *allocate_free_block(pool *p, unsigned units)
{
    const uint64_t large_enough = p->available >> (units - 1) << (units - 1);
    if (!large_enough)
        return NULL;
    const unsigned found = bits_lowest(large_enough) + 1;
    unsigned char *block = remove_first_free_block(p, found);
    add_free_block(p, block + units * p->unit, found - units);
    return block;
}

/* Returns whether free blocks should be joined: more than an eighth of the pool is free, and more than half of the free
 * units were freed since the last joining. The time for joining is proportional to the number of free blocks, so the
 * amortized cost per freed block is constant. */
static bool is_worth_joining(const pool *p)
{
    return p->free_units > p->total_units / 8 && p->freed_units > p->free_units / 2;
}

/* Take a free block from the lender. Returns null if the lender has no free block that is large enough. */
static void *borrow_free_block(pool *p, unsigned units)
{
    arena_lock(p->memory->shared);
    void *block = allocate_free_block(p->lender, units);
    arena_unlock(p->memory->shared);
    return block;
}

void *pool_allocate(pool *p, unsigned units)
{
    void *block = allocate_free_block(p, units);
    if (!block && p->borrows) {
        block = borrow_free_block(p, units);
    } else if (!block && !p->lender && p->fresh_units < units && is_worth_joining(p)) {
        join_free_blocks(p);
        block = allocate_free_block(p, units);
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

/* ---- Pools of tasks ----------------------------------------------------------------------------------------- */

static bool has_many_free_units(const pool *p)
{
    return p->free_units + p->fresh_units > p->total_units / 8;
}

void pool_init_borrowing(pool *p, arena *memory, pool *lender, size_t expected_units)
{
    pool_init(p, memory, lender->unit);
    p->expected = expected_units;
    p->lender = lender;
    p->borrows = has_many_free_units(lender);
}

/* Move the unused units of the newest slab to the free lists, the last units first, so that later allocations begin
 * with the first units. */
static void free_unused_units(pool *p)
{
    while (p->fresh_units > 0) {
        const unsigned rest = (unsigned)(p->fresh_units % POOL_MAX_UNITS), units = rest ? rest : POOL_MAX_UNITS;
        p->fresh_units -= units;
        add_free_block(p, p->fresh + p->fresh_units * p->unit, units);
    }
}

void pool_prepare_lending(pool *p)
{
    if (!has_many_free_units(p))
        return;
    free_unused_units(p);
    if (is_worth_joining(p))
        join_free_blocks(p);
}

static void join_slabs(pool *lender, pool *p)
{
    struct slab *last = p->slabs;
    if (!last)
        return;
    while (last->next)
        last = last->next;
    last->next = lender->slabs;
    lender->slabs = p->slabs;
    lender->slab_count += p->slab_count;
    lender->total_units += p->total_units;
}

void pool_join(pool *lender, pool *p)
{
    free_unused_units(p);
    join_slabs(lender, p);
    for (unsigned i = 0; i < POOL_MAX_UNITS; i++) {
        if (!p->free_blocks[i])
            continue;
        p->last_free[i]->next = lender->free_blocks[i];
        if (!lender->free_blocks[i])
            lender->last_free[i] = p->last_free[i];
        lender->free_blocks[i] = p->free_blocks[i];
    }
    lender->available |= p->available;
    lender->free_units += p->free_units;
    lender->freed_units += p->freed_units;
    pool_init_borrowing(p, p->memory, lender, 0);
}

void *list_append(arena *memory, list *l, size_t item_size)
{
    if (l->count == l->room) {
        const size_t room = l->room ? 2 * l->room : 16;
        /* cannot overflow: no allocation is larger than PTRDIFF_MAX */
        void *items = arena_allocate(memory, room * item_size);
        if (!items)
            return NULL;
        if (l->count)
            memcpy(items, l->items, l->count * item_size);
        arena_free(memory, l->items, l->room * item_size);
        l->items = items;
        l->room = room;
    }
    return (unsigned char *)l->items + l->count++ * item_size;
}

void list_release(arena *memory, list *l, size_t item_size)
{
    arena_free(memory, l->items, l->room * item_size);
    *l = (list){0};
}

void list_sort(list *l, size_t item_size, int (*compare)(const void *a, const void *b))
{
    if (l->count > 1)
        qsort(l->items, l->count, item_size, compare);
}

static uint64_t read_first_word(const void *item)
{
    uint64_t word;
    memcpy(&word, item, sizeof word);
    return word;
}

int compare_first_words(const void *a, const void *b)
{
    return (read_first_word(a) > read_first_word(b)) - (read_first_word(a) < read_first_word(b));
}

size_t find_item_by_first_word(const void *items, size_t item_size, size_t count, uint64_t word)
{
    size_t first = 0;
    while (first < count) {
        const size_t middle = first + (count - first) / 2;
        if (read_first_word((const char *)items + middle * item_size) < word)
            first = middle + 1;
        else
            count = middle;
    }
    return first;
}
