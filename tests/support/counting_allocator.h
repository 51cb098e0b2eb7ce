/* SPDX-License-Identifier: MIT */
/* counting_allocator.h - an allocator for tests: counts every byte, checks every release, fails on demand.
 */
#ifndef COUNTING_ALLOCATOR_H
#define COUNTING_ALLOCATOR_H

#include "octree/octree.h"

typedef struct counting_allocator {
    size_t bytes;      /* taken and not yet given back */
    size_t blocks;     /* likewise */
    size_t peak;       /* the most bytes at one time */
    size_t calls;      /* allocations asked for, refused ones included */
    size_t fail_from;  /* the first call that fails ... */
    size_t fail_until; /* ... and the first after it that does not: equal means none fails */
    size_t wrong;      /* releases with a size that is not the block's, or of null */
} counting_allocator;

/* An allocator upon these counts, which begin as {0}. */
octree_allocator counting_allocator_use(counting_allocator *counts);

/* Let the n-th allocation from now fail, counted from 0, and only that one. */
void counting_allocator_fail_at(counting_allocator *counts, size_t n);

/* Let no more fail. */
void counting_allocator_heal(counting_allocator *counts);

/* A new tree whose memory is counted, as make_tree. */
octree *make_counted_tree(counting_allocator *counts, octree_box world, size_t capacity, size_t depth,
                          octree_full_leaf full_leaf);

/* The test fails when a block is still out, or one came back wrongly. */
void assert_all_returned(const counting_allocator *counts);

#endif
