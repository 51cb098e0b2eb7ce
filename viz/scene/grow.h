/* grow.h - room for more items in an array that doubles. */
#ifndef SCENE_GROW_H
#define SCENE_GROW_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/* The array, in which there is room for `count` items, and to be freed; `first` is its room when it was empty. Null
 * when there is no memory: nothing has changed then. Cost: O(1) an item, amortized. */
static inline void *grow_to(void *items, size_t count, size_t *room, size_t first, size_t item_size)
{
    if (count <= *room)
        return items;
    size_t wanted = *room ? *room : first;
    while (wanted < count && wanted <= SIZE_MAX / 2)
        wanted *= 2;
    void *grown = count <= wanted && wanted <= SIZE_MAX / item_size ? realloc(items, wanted * item_size) : NULL;
    if (grown)
        *room = wanted;
    return grown;
}

/* The same for one item behind `count` of them. */
static inline void *grow_by_one(void *items, size_t count, size_t *room, size_t first, size_t item_size)
{
    return grow_to(items, count + 1, room, first, item_size);
}

#endif
