/* SPDX-License-Identifier: MIT */
/* counting_allocator.h - an allocator for tests that counts bytes, checks releases, and fails on demand. */
#ifndef COUNTING_ALLOCATOR_H
#define COUNTING_ALLOCATOR_H

#include "octree/octree.h"

typedef struct counting_allocator {
    size_t bytes;      /* allocated and not yet released */
    size_t blocks;     /* allocated and not yet released */
    size_t peak;       /* the most bytes at one time */
    size_t calls;      /* number of allocations, failed ones included */
    size_t fail_from;  /* the first call that fails ... */
    size_t fail_until; /* ... and the first after it that does not: equal means none fails */
    size_t wrong;      /* releases with a size that is not the block's, or of null */
} counting_allocator;

/* An allocator that uses these counts; initialize them with {0}. */
octree_allocator counting_allocator_use(counting_allocator *counts);

/* Let the n-th allocation from now fail, counted from 0, and only that one. */
void counting_allocator_fail_at(counting_allocator *counts, size_t n);

/* Let no further allocation fail. */
void counting_allocator_stop_failing(counting_allocator *counts);

/* A new tree whose memory is counted, as make_tree. */
octree *make_counted_tree(counting_allocator *counts, octree_box world, size_t capacity, size_t depth,
                          octree_full_leaf full_leaf);

/* The test fails if a block was not released, or a release was wrong. */
void assert_all_returned(const counting_allocator *counts);

#endif
