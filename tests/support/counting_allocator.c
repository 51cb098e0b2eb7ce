/* SPDX-License-Identifier: MIT */
#include "counting_allocator.h"

#include <stdlib.h>

#include "fixture.h"

/* Stands before each block; as large as the strictest alignment, so that the block keeps malloc's. */
typedef union header {
    size_t size;
    max_align_t align;
} header;

static void *count_allocate(size_t size, void *context)
{
    counting_allocator *counts = context;
    size_t call = counts->calls++;
    if (call >= counts->fail_from && call < counts->fail_until)
        return NULL;
    header *block = malloc(sizeof *block + size);
    if (block == NULL)
        return NULL;
    block->size = size;
    counts->blocks++;
    counts->bytes += size;
    if (counts->bytes > counts->peak)
        counts->peak = counts->bytes;
    return block + 1;
}

static void count_release(void *memory, size_t size, void *context)
{
    counting_allocator *counts = context;
    if (memory == NULL) {
        counts->wrong++;
        return;
    }
    header *block = (header *)memory - 1;
    if (block->size != size)
        counts->wrong++;
    counts->blocks--;
    counts->bytes -= block->size;
    free(block);
}

octree_allocator counting_allocator_use(counting_allocator *counts)
{
    return (octree_allocator){count_allocate, count_release, counts};
}

void counting_allocator_fail_at(counting_allocator *counts, size_t n)
{
    counts->fail_from = counts->calls + n;
    counts->fail_until = counts->fail_from + 1;
}

void counting_allocator_stop_failing(counting_allocator *counts)
{
    counts->fail_from = 0;
    counts->fail_until = 0;
}

octree *make_counted_tree(counting_allocator *counts, octree_box world, size_t capacity, size_t depth,
                          octree_full_leaf full_leaf)
{
    octree_def def = define(world, capacity, depth, full_leaf);
    def.allocator = counting_allocator_use(counts);
    octree *tree = NULL;
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    return tree;
}

void assert_all_returned(const counting_allocator *counts)
{
    assert_int_equal(counts->blocks, 0);
    assert_int_equal(counts->bytes, 0);
    assert_int_equal(counts->wrong, 0);
}
