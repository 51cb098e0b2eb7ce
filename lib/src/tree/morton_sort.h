/* SPDX-License-Identifier: MIT */
/* morton_sort.h - sorting points by their Morton codes. */
#ifndef OCTREE_MORTON_SORT_H
#define OCTREE_MORTON_SORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A point to sort: its Morton code and its index. */
typedef struct morton_item {
    uint64_t code;
    uint32_t place; /* the index of the point in the caller's array */
    uint32_t index; /* the index of a stored point in its leaf; MORTON_NEW for a point that is not stored */
} morton_item;

#define MORTON_NEW UINT32_MAX

/* The greatest value of `unsorted` that callers may pass. */
#define MORTON_UNSORTED 64

/* Sort the items of a cell of this depth by code; items of equal code keep their order. Cells of at most `unsorted`
 * items (up to MORTON_UNSORTED) stay in any order, but with equal codes adjacent: they become leaves, whose items need
 * no order. `spare` has room for `count` items. Returns false if all codes differ, true if some may be equal.
 * Cost: O(count), in up to 21 passes, usually two or three. */
bool morton_sort(morton_item *items, morton_item *spare, size_t count, unsigned depth, size_t unsorted);

/* Sort the items of the whole world, by tasks if there are many. `differ` says that all ids differ: equal codes need
 * not be adjacent in unsorted cells then, and are not detected there. */
struct octree;
struct arena;
bool morton_sort_tasks(const struct octree *tree, struct arena *memory, morton_item *items, morton_item *spare,
                       size_t count, size_t unsorted, bool differ);

#endif
