/* SPDX-License-Identifier: MIT */
/* array.h - growing arrays: items, a count and the room there is, which doubles. */
#ifndef BASE_ARRAY_H
#define BASE_ARRAY_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/* The array with room for `count` items, to be freed with free(). Null when there is no memory: the old array is then
 * unchanged. Cost: O(1) an item, amortized. */
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

#endif
