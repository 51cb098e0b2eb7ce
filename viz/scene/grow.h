/* grow.h - room for one more item in an array that doubles. */
#ifndef SCENE_GROW_H
#define SCENE_GROW_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/* The array, in which there is room for an item behind `count` of them, and to be freed; `first` is its room when it
 * was empty. Null when there is no memory: nothing has changed then. Cost: O(1) an item, amortized. */
static inline void *grow_by_one(void *items, size_t count, size_t *room, size_t first, size_t item_size)
{
    if (count < *room)
        return items;
    const size_t wanted = *room ? 2 * *room : first;
    void *grown = wanted <= SIZE_MAX / item_size ? realloc(items, wanted * item_size) : NULL;
    if (grown)
        *room = wanted;
    return grown;
}

#endif
