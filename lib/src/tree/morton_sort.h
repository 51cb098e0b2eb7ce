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

/* As many items as may be left loose. */
#define MORTON_LOOSE 64

/* Sort the items of a cell of this depth by code. The items of a cell that holds at most `loose` of them, up to
 * MORTON_LOOSE, lie together in any order, those of one code side by side: what becomes a leaf is not worth sorting.
 * False when no two items have one code, true when some may. `spare` is room for as many items. Cost: O(count), for up
 * to 21 passes, most often two or three.
 */
bool morton_sort(morton_item *items, morton_item *spare, size_t count, unsigned depth, size_t loose);

#endif
