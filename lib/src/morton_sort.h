/* morton_sort.h - points in the order of their Morton codes. Private. */
#ifndef OCTREE_MORTON_SORT_H
#define OCTREE_MORTON_SORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A point by its code, and where it is. */
typedef struct morton_item {
    uint64_t code;
    uint32_t place; /* in the caller's array, or in a leaf */
    bool stored;    /* in a leaf */
} morton_item;

/* Sort by code; items of one code stay in their order. `spare` is room for as many items. Cost: O(count), for up to
 * eight passes. */
void morton_sort(morton_item *items, morton_item *spare, size_t count);

#endif
