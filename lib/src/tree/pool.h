/* SPDX-License-Identifier: MIT */
/* pool.h - where memory comes from: an arena (the caller's allocator and its byte count), pools, growing arrays.
 *
 * A pool hands out blocks of 1 to 64 equal units from large slabs, with one free list for each size. A tree has two:
 * for groups of sibling nodes, and for the points of leaves. A freed block is reused whole or split. Adjacent free
 * blocks are joined before the pool grows, if enough of it is free: so freeing takes a few instructions, and memory
 * does not fragment under churn. Slabs go back to the allocator when the tree is cleared or destroyed.
 */
#ifndef OCTREE_POOL_H
#define OCTREE_POOL_H

#include "octree/types.h"

#include <stdatomic.h>
#include <string.h>

#define POOL_MAX_UNITS 64

/* The allocator of a tree or a game, and how many bytes are allocated from it. That of a task allocates from the
 * tree's, one task at a time. */
typedef struct arena {
    octree_allocator allocator;
    size_t bytes;
    struct arena *shared; /* the tree's; null but for a task's */
    atomic_flag busy;     /* while one of the tasks takes or gives */
} arena;

static inline void arena_lock(arena *a)
{
    /* unreachable: but by chance, when two threads ask at once */
    while (atomic_flag_test_and_set_explicit(&a->busy, memory_order_acquire))
        ;
}

static inline void arena_unlock(arena *a)
{
    atomic_flag_clear_explicit(&a->busy, memory_order_release);
}

/* malloc's. */
octree_allocator default_allocator(void);

void *arena_take(arena *a, size_t size);
void arena_give(arena *a, void *memory, size_t size);

typedef struct pool {
    arena *memory;
    size_t unit; /* bytes, at least a pointer's */
    struct slab *slabs;
    size_t slab_count;
    size_t expected;      /* units that are needed at first; 0: nobody knows */
    unsigned char *fresh; /* units of the newest slab that were never handed out */
    size_t fresh_units;
    size_t total_units;
    size_t free_units;  /* in the free lists */
    size_t freed_units; /* since free blocks were last joined */
    uint64_t available; /* bit u - 1 is set when free_blocks[u - 1] is not empty */
    struct free_block *free_blocks[POOL_MAX_UNITS];
    struct free_block *last_free[POOL_MAX_UNITS]; /* of each list that is not empty */
    struct pool *lender;                          /* the tree's pool, for that of a task; else null */
    bool borrows;                                 /* from the lender, before it grows */
} pool;

void pool_init(pool *p, arena *memory, size_t unit);
void pool_release(pool *p);

/* A block of 1..POOL_MAX_UNITS units, or null when there is no memory. */
void *pool_take(pool *p, unsigned units);

/* Free a block, or the end of one: any run of units within a block that was taken. */
void pool_give(pool *p, void *block, unsigned units);

/* A pool for a task of the tree's. Where much of the tree's is free it takes that before it grows; how many bytes are
 * taken then depends on which task comes first. (Shares that are dealt beforehand do not: but where points arrive in
 * one place each time, the pool of that place grows with each batch, while the others' shares lie idle.) Until all are
 * joined, the tree's pool is used by them alone. */
void pool_borrow(pool *p, arena *memory, pool *lender, size_t expected_units);
void pool_join(pool *lender, pool *p);

/* Before tasks borrow from a pool: where much of it is free, let all of that be free blocks. */
void pool_lend(pool *p);

/* A growing array. */
typedef struct list {
    void *items;
    size_t count;
    size_t room;
} list;

/* Space for one more item of this size, which must be the same at every call; null when there is no memory. */
void *list_append(arena *memory, list *l, size_t item_size);

/* Append a copy of an item. False when there is no memory. */
static inline bool list_push(arena *memory, list *l, const void *item, size_t item_size)
{
    void *room = list_append(memory, l, item_size);
    if (room)
        memcpy(room, item, item_size);
    return room != NULL;
}

void list_release(arena *memory, list *l, size_t item_size);

#endif
