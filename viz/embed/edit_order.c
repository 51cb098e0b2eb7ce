/* SPDX-License-Identifier: MIT */
/* edit_order.c - changes become edits that are all accepted. */
#include "edit_order.h"
#include "octree/octree.h"

#include <stdlib.h>
#include <string.h>

bool edit_order_init(edit_order *o, const octree_def *def, const points *now)
{
    *o = (edit_order){.world = def->world};
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
static bool reserve_edits(edit_order *o, size_t changes)
{
    if (changes <= o->room)
        return true;
    octree_edit *edits = realloc(o->edits, 2 * changes * sizeof *edits);
    o->edits = edits ? edits : o->edits;
    size_t *waiting = realloc(o->waiting, changes * sizeof *waiting);
    o->waiting = waiting ? waiting : o->waiting;
    if (!edits || !waiting)
        return false;
    o->room = changes;
    return true;
}

static bool is_inside(const edit_order *o, const double at[3])
{
    bool inside = true;
    for (int i = 0; i < 3; i++)
        inside &= at[i] >= o->world.min[i] && at[i] <= o->world.max[i];
    return inside;
}

/* Whether an edit of this kind is among those that a change becomes. */
static bool needs(const edit_order *o, const change *c, octree_edit_kind kind)
{
    const bool from = c->kind != OCTREE_EDIT_INSERT && is_inside(o, c->from);
    const bool to = c->kind != OCTREE_EDIT_REMOVE && is_inside(o, c->to);
    if (kind == OCTREE_EDIT_INSERT)
        return c->kind != OCTREE_EDIT_REMOVE && !(from && to);
    return from && to == (kind == OCTREE_EDIT_MOVE);
}

/* Make a change as an edit of this kind, where there is room for it. False when there is no memory; *made is whether
 * it was made. */
static bool try_change(edit_order *o, uint64_t tick, octree_edit_kind kind, const change *c, bool *made)
{
    octree_status status = OCTREE_OK;
    if (o->tree && kind == OCTREE_EDIT_REMOVE)
        status = octree_remove(o->tree, c->from, c->id);
    else if (o->tree && kind == OCTREE_EDIT_MOVE)
        status = octree_move(o->tree, c->from, c->id, c->to);
    else if (o->tree)
        status = octree_insert(o->tree, c->to, c->id);
    *made = status != OCTREE_FULL && status != OCTREE_NO_MEMORY;
    if (*made) {
        octree_edit *edit = &o->edits[o->count++];
        *edit = (octree_edit){.tick = tick, .kind = kind, .body.id = c->id};
        if (kind != OCTREE_EDIT_REMOVE)
            memcpy(edit->body.position, c->to, sizeof edit->body.position);
    }
    return status != OCTREE_NO_MEMORY;
}

/* Make the edits of a kind; those that find no room wait. */
static bool make_all(edit_order *o, const batch *b, uint64_t tick, octree_edit_kind kind, size_t *waiting)
{
    for (size_t i = 0; i < b->change_count; i++) {
        bool made;
        if (!needs(o, &b->changes[i], kind))
            continue;
        if (!try_change(o, tick, kind, &b->changes[i], &made))
            return false;
        if (!made)
            o->waiting[(*waiting)++] = i;
    }
    return true;
}

/* Make all waiting changes as edits of this kind; those that still find no room stay in the list. */
static bool make_waiting(edit_order *o, const batch *b, uint64_t tick, octree_edit_kind kind, size_t *waiting)
{
    size_t left = 0;
    for (size_t i = 0; i < *waiting; i++) {
        bool made;
        if (!try_change(o, tick, kind, &b->changes[o->waiting[i]], &made))
            return false;
        if (!made || kind == OCTREE_EDIT_REMOVE) /* to be put back in */
            o->waiting[left++] = o->waiting[i];
    }
    *waiting = left;
    return true;
}

bool edit_order_make(edit_order *o, const batch *b, uint64_t tick)
{
    size_t waiting = 0;
    o->count = 0;
    return reserve_edits(o, b->change_count) && make_all(o, b, tick, OCTREE_EDIT_REMOVE, &waiting) &&
           make_all(o, b, tick, OCTREE_EDIT_MOVE, &waiting) && make_waiting(o, b, tick, OCTREE_EDIT_MOVE, &waiting) &&
           make_waiting(o, b, tick, OCTREE_EDIT_REMOVE, &waiting) &&
           make_waiting(o, b, tick, OCTREE_EDIT_INSERT, &waiting) && make_all(o, b, tick, OCTREE_EDIT_INSERT, &waiting);
}
