/* SPDX-License-Identifier: MIT */
/* morton_sort.h - sorts points by their Morton codes. */
#ifndef OCTREE_MORTON_SORT_H
#define OCTREE_MORTON_SORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A point to sort: its Morton code and its index. */
typedef struct morton_item {
    uint64_t code;
    uint32_t place; /* the index of the point in the caller's array */
    /* the index of the point in its leaf if the tree stores it; MORTON_NEW for a point that is not stored */
    uint32_t index;
} morton_item;

#define MORTON_NEW UINT32_MAX

/* The maximum value of the parameter `unsorted`. */
#define MORTON_UNSORTED 64

/* Sort the items of a cell of this depth by code; items of equal code keep their order. A smaller cell of at most
 * `unsorted` items (up to MORTON_UNSORTED) becomes a leaf, whose items need no order: they stay unsorted, but equal
 * codes are adjacent. `spare` has room for `count` items. Returns false if all codes differ, true if some codes may be
 * equal. Cost: O(count), in up to 21 passes, usually two or three. */
bool morton_sort(morton_item *items, morton_item *spare, size_t count, unsigned depth, size_t unsorted);

/* Sort the items of the whole world, by tasks if there are many items. If `differ` is true, all ids differ: in unsorted
 * cells equal codes then need not be adjacent, and are not detected. */
struct octree;
struct arena;
bool morton_sort_by_tasks(const struct octree *tree, struct arena *memory, morton_item *items, morton_item *spare,
                          size_t count, size_t unsorted, bool differ);

#endif
