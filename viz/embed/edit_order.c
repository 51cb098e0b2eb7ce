/* edit_order.c - see edit_order.h. */
#include "edit_order.h"

#include <stdlib.h>
#include <string.h>

bool edit_order_init(edit_order *o, const octree_def *def, const points *now)
{
    *o = (edit_order){0};
    if (def->full_leaf == OCTREE_GROW)
        return true;
    return octree_create(def, &o->tree) == OCTREE_OK &&
           (now->count == 0 || octree_insert_many(o->tree, now->items, now->count, NULL, NULL) == OCTREE_OK);
}

void edit_order_release(edit_order *o)
{
    octree_destroy(o->tree);
    free(o->edits);
    free(o->waiting);
    *o = (edit_order){0};
}

/* Each change is one edit, or two: out and in again. */
static bool reserve(edit_order *o, size_t changes)
{
    if (2 * changes > o->room) {
        octree_edit *edits = realloc(o->edits, 2 * changes * sizeof *edits);
        if (!edits)
            return false;
        o->edits = edits;
        o->room = 2 * changes;
    }
    if (changes > o->waiting_room) {
        size_t *waiting = realloc(o->waiting, changes * sizeof *waiting);
        if (!waiting)
            return false;
        o->waiting = waiting;
        o->waiting_room = changes;
    }
    return true;
}

static void add(edit_order *o, uint64_t tick, octree_edit_kind kind, const change *c)
{
    octree_edit *edit = &o->edits[o->count++];
    *edit = (octree_edit){.tick = tick, .kind = kind, .body.id = c->id};
    if (kind != OCTREE_EDIT_REMOVE)
        memcpy(edit->body.position, c->to, sizeof edit->body.position);
}

/* Make a change where there is room for it. False when there is no memory; *made tells the rest. */
static bool try_change(edit_order *o, uint64_t tick, octree_edit_kind kind, const change *c, bool *made)
{
    octree_status status = OCTREE_OK;
    if (o->tree && kind == OCTREE_EDIT_REMOVE)
        status = octree_remove(o->tree, c->from, c->id);
    else if (o->tree && kind == OCTREE_EDIT_MOVE)
        status = octree_move(o->tree, c->from, c->id, c->to);
    else if (o->tree)
        status = octree_insert(o->tree, c->to, c->id);
    *made = status != OCTREE_FULL;
    if (*made && status != OCTREE_NO_MEMORY)
        add(o, tick, kind, c);
    return status != OCTREE_NO_MEMORY;
}

/* Try what found no room once more; those that still find none stay. */
static bool try_waiting(edit_order *o, const batch *b, uint64_t tick, size_t *waiting)
{
    size_t left = 0;
    for (size_t i = 0; i < *waiting; i++) {
        bool made;
        const change *c = &b->changes[o->waiting[i]];
        if (!try_change(o, tick, c->kind, c, &made))
            return false;
        if (!made)
            o->waiting[left++] = o->waiting[i];
    }
    *waiting = left;
    return true;
}

/* Take out what is waiting, and put it in where it belongs: when all of it is out, there is room. */
static bool exchange(edit_order *o, const batch *b, uint64_t tick, size_t waiting)
{
    bool made;
    for (size_t i = 0; i < waiting; i++)
        if (!try_change(o, tick, OCTREE_EDIT_REMOVE, &b->changes[o->waiting[i]], &made))
            return false;
    for (size_t i = 0; i < waiting; i++)
        if (!try_change(o, tick, OCTREE_EDIT_INSERT, &b->changes[o->waiting[i]], &made))
            return false;
    return true;
}

bool edit_order_make(edit_order *o, const batch *b, uint64_t tick)
{
    size_t waiting = 0, i = 0;
    bool made;
    o->count = 0;
    if (!reserve(o, b->change_count))
        return false;
    for (; i < b->change_count && b->changes[i].kind != OCTREE_EDIT_INSERT; i++) {
        if (!try_change(o, tick, b->changes[i].kind, &b->changes[i], &made))
            return false;
        if (!made)
            o->waiting[waiting++] = i;
    }
    if (!try_waiting(o, b, tick, &waiting) || !exchange(o, b, tick, waiting))
        return false;
    for (; i < b->change_count; i++)
        if (!try_change(o, tick, OCTREE_EDIT_INSERT, &b->changes[i], &made))
            return false;
    return true;
}
