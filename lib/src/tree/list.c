/* list.c - see list.h. */
#include "list.h"

#include <string.h>

void *list_append(arena *memory, list *l, size_t item_size)
{
    if (l->count == l->room) {
        const size_t room = l->room ? 2 * l->room : 16;
        void *items = room <= SIZE_MAX / item_size ? arena_take(memory, room * item_size) : NULL;
        if (!items)
            return NULL;
        if (l->count)
            memcpy(items, l->items, l->count * item_size);
        arena_give(memory, l->items, l->room * item_size);
        l->items = items;
        l->room = room;
    }
    return (unsigned char *)l->items + l->count++ * item_size;
}

void list_release(arena *memory, list *l, size_t item_size)
{
    arena_give(memory, l->items, l->room * item_size);
    *l = (list){0};
}
