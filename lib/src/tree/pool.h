/* SPDX-License-Identifier: MIT */
/* pool.h - memory: an arena (the caller's allocator with a byte count), pools of small blocks, and growing arrays.
 *
 * A pool allocates blocks of 1 to 64 equal units from large slabs, with one free list for each size. A tree has two
 * pools: for groups of sibling nodes and for the points of leaves. If enough of a pool is free, adjacent free blocks
 * are joined before the pool grows. Slabs are released when the tree is cleared or destroyed.
 */
#ifndef OCTREE_POOL_H
#define OCTREE_POOL_H

#include "octree/types.h"

#include <stdatomic.h>
#include <string.h>

#define POOL_MAX_UNITS 64

/* The allocator of a tree or a game, with a count of the allocated bytes. The arena of a task calls the tree's arena
 * under a lock. */
typedef struct arena {
    octree_allocator allocator;
    size_t bytes;
    struct arena *shared; /* only in the arena of a task: the tree's arena; else null */
    atomic_flag busy;     /* the lock that tasks take when they use this arena */
} arena;

static inline void arena_lock(arena *a)
{
    /* unreachable: no test can force two threads to allocate at the same time, so the loop runs only by chance */
    while (atomic_flag_test_and_set_explicit(&a->busy, memory_order_acquire))
        ;
}

static inline void arena_unlock(arena *a)
{
    atomic_flag_clear_explicit(&a->busy, memory_order_release);
}

/* An allocator that calls malloc and free. */
octree_allocator default_allocator(void);

/* arena_allocate() returns null if memory runs out. arena_free() needs the size that was allocated; `memory` may be
 * null. */
void *arena_allocate(arena *a, size_t size);
void arena_free(arena *a, void *memory, size_t size);

typedef struct pool {
    arena *memory;
    size_t unit; /* the size of a unit in bytes, at least the size of a pointer */
    struct slab *slabs;
    size_t slab_count;
    size_t expected; /* the number of units that will soon be needed; 0: unknown */
    /* in the newest slab, the first unit that was never allocated; fresh_units units from here on are unused */
    unsigned char *fresh;
    size_t fresh_units;
    size_t total_units;
    size_t free_units;  /* the number of units in the free lists */
    size_t freed_units; /* the number of units freed since free blocks were last joined */
    uint64_t available; /* bit u - 1 is set if free_blocks[u - 1] is not empty */
    struct free_block *free_blocks[POOL_MAX_UNITS];
    struct free_block *last_free[POOL_MAX_UNITS]; /* the last block of each free list that is not empty */
    /* only in the pool of a task: the tree's pool, which lends blocks; else null */
    struct pool *lender;
    bool borrows; /* true: take free blocks from `lender` before growing */
} pool;

void pool_init(pool *p, arena *memory, size_t unit);
void pool_release(pool *p);

/* Allocate a block of 1 to POOL_MAX_UNITS units. Returns null if memory runs out. */
void *pool_allocate(pool *p, unsigned units);

/* Free a block, or some adjacent units of a block. */
void pool_free(pool *p, void *block, unsigned units);

/* Make a pool for a task. If much of the tree's pool is free, the task borrows blocks from it before its own pool
 * grows. pool_join() moves all memory of the task's pool to the tree's pool; before this call, only the tasks use the
 * tree's pool.
 *
 * Because of borrowing, the total memory depends slightly on the order of tasks. A fixed share of the free blocks for
 * each task would avoid this dependence, but would need more memory: if points always arrive in one region, the pool of
 * that region would grow with each batch while the shares of other regions stay unused. */
void pool_init_borrowing(pool *p, arena *memory, pool *lender, size_t expected_units);
void pool_join(pool *lender, pool *p);

/* Prepare a pool for lending blocks to the pools of tasks. If much of the pool is free, move all of its free units into
 * the free lists. */
void pool_prepare_lending(pool *p);

/* A growing array. */
typedef struct list {
    void *items;
    size_t count;
    size_t room;
} list;

/* Append space for one item. Returns null if memory runs out. The item size must be the same in every call. */
void *list_append(arena *memory, list *l, size_t item_size);

/* Append a copy of an item. Returns false if memory runs out. */
static inline bool list_push(arena *memory, list *l, const void *item, size_t item_size)
{
    void *room = list_append(memory, l, item_size);
    if (room)
        memcpy(room, item, item_size);
    return room != NULL;
}

void list_release(arena *memory, list *l, size_t item_size);

/* Sort all items with qsort(). */
void list_sort(list *l, size_t item_size, int (*compare)(const void *a, const void *b));

/* Functions for items that begin with a uint64_t. compare_first_words() compares two such items, for qsort().
 * find_item_by_first_word() searches `count` items that are sorted by this word. It returns the index of the first item
 * whose word is at least `word`, or `count` if there is none. */
int compare_first_words(const void *a, const void *b);
size_t find_item_by_first_word(const void *items, size_t item_size, size_t count, uint64_t word);

#endif
