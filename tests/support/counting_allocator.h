/* SPDX-License-Identifier: MIT */
/* counting_allocator.h - an allocator for tests that counts bytes, checks releases, and fails on demand. */
#ifndef COUNTING_ALLOCATOR_H
#define COUNTING_ALLOCATOR_H

#include "octree/octree.h"

typedef struct counting_allocator {
    size_t bytes;      /* number of bytes that are allocated and not yet released */
    size_t blocks;     /* number of blocks that are allocated and not yet released */
    size_t peak;       /* the most bytes at one time */
    size_t calls;      /* number of allocations, failed ones included */
    size_t fail_from;  /* number of the first call that fails */
    size_t fail_until; /* number of the next call that succeeds; equal to fail_from: no call fails */
    size_t wrong;      /* number of releases of null, or with a size other than the block's */
} counting_allocator;

/* An allocator that uses these counts; initialize them with {0}. */
octree_allocator counting_allocator_use(counting_allocator *counts);

/* Let only the n-th allocation from now on fail, counted from 0. */
void counting_allocator_fail_at(counting_allocator *counts, size_t n);

/* Let no further allocation fail. */
void counting_allocator_stop_failing(counting_allocator *counts);

/* Like make_tree(), but the tree's memory is counted. */
octree *make_counted_tree(counting_allocator *counts, octree_box world, size_t capacity, size_t depth,
                          octree_full_leaf full_leaf);

/* The test fails if a block was not released, or a release was wrong. */
void assert_all_returned(const counting_allocator *counts);

#endif
