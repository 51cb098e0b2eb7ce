/* pool.h - blocks of 1 to 64 equal units out of large slabs, with one free list a size.
 *
 * A tree has two pools: one for groups of sibling nodes, one for the points of leaves. A block that is given back is
 * reused whole or in parts. Neighbouring free blocks are joined again before the pool grows, when enough of it is free:
 * so giving back is a few instructions, and churn does not eat memory. The slabs go back to the allocator when the tree
 * is cleared or destroyed.
 */
#ifndef OCTREE_POOL_H
#define OCTREE_POOL_H

#include "octree/octree.h"

#define POOL_MAX_UNITS 64

/* The tree's memory: its allocator, and how many bytes are out. */
typedef struct arena {
    octree_allocator allocator;
    size_t bytes;
} arena;

void *arena_take(arena *a, size_t size);
void arena_give(arena *a, void *memory, size_t size);

typedef struct pool {
    arena *memory;
    size_t unit; /* bytes, at least a pointer's */
    struct slab *slabs;
    unsigned char *fresh; /* untouched units of the newest slab */
    size_t fresh_units;
    size_t total_units;
    size_t free_units;  /* in the free lists */
    size_t given_units; /* given back since free blocks were last joined */
    uint64_t available; /* bit u - 1 is set when free_blocks[u - 1] is not empty */
    struct free_block *free_blocks[POOL_MAX_UNITS];
} pool;

void pool_init(pool *p, arena *memory, size_t unit);
void pool_release(pool *p);

/* A block of 1..POOL_MAX_UNITS units, or null when there is no memory. */
void *pool_take(pool *p, unsigned units);

/* Give a block back, or the tail of one: any run of units that was taken. */
void pool_give(pool *p, void *block, unsigned units);

#endif
