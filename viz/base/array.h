/* SPDX-License-Identifier: MIT */
/* array.h - growing arrays, and a comparison function for sorted arrays. The caller stores the pointer to the items,
 * their count and the capacity `room`. When an array is full, its capacity is doubled. */
#ifndef BASE_ARRAY_H
#define BASE_ARRAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Returns an array with the same items and capacity for at least `count` items, and sets *room to its capacity. The
 * caller frees the array with free(). If memory runs out, returns null; the old array is then unchanged and still
 * belongs to the caller. Cost: O(1) per item, amortized. */
static inline void *array_reserve(void *items, size_t count, size_t *room, size_t item_size)
{
    enum { SMALLEST_ROOM = 16 };
    if (count <= *room)
        return items;
    size_t wanted = *room ? *room : SMALLEST_ROOM;
    while (wanted < count && wanted <= SIZE_MAX / 2)
        wanted *= 2;
    void *grown = count <= wanted && wanted <= SIZE_MAX / item_size ? realloc(items, wanted * item_size) : NULL;
    if (grown)
        *room = wanted;
    return grown;
}

/* Grows an array to a capacity of at least `count` items. `array` is the address of the pointer to the items. Returns
 * false and leaves the array unchanged if memory runs out. */
static inline bool array_grow(void *array, size_t count, size_t *room, size_t item_size)
{
    void *items;
    memcpy(&items, array, sizeof items); /* memcpy(), because the type of the caller's pointer is not void * */
    items = array_reserve(items, count, room, item_size);
    if (items || count == 0)
        memcpy(array, &items, sizeof items);
    return items || count == 0;
}

/* A type for an array that owns its items. ARRAY_GROW() makes room for `more` further items; it returns false if memory
 * runs out.
 *   ARRAY(int) list = {0};
 *   if (ARRAY_GROW(&list, 1))
 *       list.items[list.count++] = 7;
 */
#define ARRAY(type)                                                                                                    \
    struct {                                                                                                           \
        type *items;                                                                                                   \
        size_t count, room;                                                                                            \
    }
#define ARRAY_GROW(array, more)                                                                                        \
    array_grow(&(array)->items, (array)->count + (more), &(array)->room, sizeof *(array)->items)

/* Compares two items by their first member, which is a uint64_t. For qsort() and bsearch(). */
static inline int compare_uint64(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Compares two items that are doubles. For qsort(). */
static inline int compare_float64(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

#endif
