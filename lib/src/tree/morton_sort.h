/* SPDX-License-Identifier: MIT */
/* morton_sort.h - sorting points by their Morton codes. */
#ifndef OCTREE_MORTON_SORT_H
#define OCTREE_MORTON_SORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A point: its code, and where it is. */
typedef struct morton_item {
    uint64_t code;
    uint32_t place; /* index in the caller's array */
    uint32_t index; /* of a stored point in its leaf; MORTON_NEW for one that is not stored */
} morton_item;

#define MORTON_NEW UINT32_MAX

/* Cells of at most this many items may be left unsorted. */
#define MORTON_UNSORTED 64

/* Sort the items of a cell of this depth by code; those of one code keep their order. Cells that hold at most
 * `unsorted` items, up to MORTON_UNSORTED, are left in any order, but with equal codes side by side: what becomes a
 * leaf need not be sorted. False when all codes differ, true when some may be equal. `spare` has room for as many
 * items. Cost: O(count), in up to 21 passes, most often two or three. */
bool morton_sort(morton_item *items, morton_item *spare, size_t count, unsigned depth, size_t unsorted);

/* The same for all of the world, by the tasks of a tree's executor where there are many items. Where all ids `differ`
 * equal codes need not be side by side, and are not looked for in cells that are left unsorted. */
struct octree;
struct arena;
bool morton_sort_tasks(const struct octree *tree, struct arena *memory, morton_item *items, morton_item *spare,
                       size_t count, size_t unsorted, bool differ);

#endif
