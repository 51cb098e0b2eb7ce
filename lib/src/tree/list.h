/* list.h - a growing array in the memory of an arena. Private. */
#ifndef OCTREE_LIST_H
#define OCTREE_LIST_H

#include "pool.h"

typedef struct list {
    void *items;
    size_t count;
    size_t room;
} list;

/* Space for one more item of this size, which must be the same at every call; null when there is no memory. */
void *list_append(arena *memory, list *l, size_t item_size);
void list_release(arena *memory, list *l, size_t item_size);

#endif
