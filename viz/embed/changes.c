/* SPDX-License-Identifier: MIT */
/* changes.c - the changes of points from one tick to the next: see changes.h. */
#include "changes.h"

#include <stdlib.h>
#include <string.h>

/* By value: -0 equals 0. */
static bool same_place(const octree_point *a, const octree_point *b)
{
    return a->position[0] == b->position[0] && a->position[1] == b->position[1] && a->position[2] == b->position[2];
}

static change make_change(const octree_point *before, const octree_point *after)
{
    change c = {.kind = !after    ? OCTREE_EDIT_REMOVE
                        : !before ? OCTREE_EDIT_INSERT
                                  : OCTREE_EDIT_MOVE,
                .id = before ? before->id : after->id};
    if (before)
        memcpy(c.from, before->position, sizeof c.from);
    if (after)
        memcpy(c.to, after->position, sizeof c.to);
    return c;
}

size_t changes_between(const points *before, const points *after, change *changes)
{
    size_t i = 0, j = 0, count = 0;
    while (i < before->count || j < after->count) {
        const octree_point *old = i < before->count ? &before->items[i] : NULL;
        const octree_point *new = j < after->count ? &after->items[j] : NULL;
        if (old && new && old->id != new->id) {
            old = old->id < new->id ? old : NULL;
            new = old ? NULL : new;
        }
        i += old != NULL;
        j += new != NULL;
        if (old && new &&same_place(old, new))
            continue;
        if (changes)
            changes[count] = make_change(old, new);
        count++;
    }
    return count;
}

static int compare_changes(const void *a, const void *b)
{
    const change *c = a, *d = b;
    return c->id != d->id ? (c->id > d->id) - (c->id < d->id) : (c->order > d->order) - (c->order < d->order);
}

/* Join the changes of one id: from before the first to after the last. False if nothing changed in total. */
static bool join_changes(const change *first, const change *last, change *joined)
{
    octree_point before = {.id = first->id}, after = {.id = last->id};
    memcpy(before.position, first->from, sizeof before.position);
    memcpy(after.position, last->to, sizeof after.position);
    const bool was = first->kind != OCTREE_EDIT_INSERT, is = last->kind != OCTREE_EDIT_REMOVE;
    if (was == is && (!was || same_place(&before, &after)))
        return false;
    *joined = make_change(was ? &before : NULL, is ? &after : NULL);
    return true;
}

size_t changes_settle(change *changes, size_t count)
{
    size_t settled = 0;
    for (size_t i = 0; i < count; i++)
        changes[i].order = (uint32_t)i;
    if (count > 1)
        qsort(changes, count, sizeof *changes, compare_changes);
    for (size_t first = 0, last; first < count; first = last + 1) {
        for (last = first; last + 1 < count && changes[last + 1].id == changes[first].id;)
            last++;
        settled += join_changes(&changes[first], &changes[last], &changes[settled]);
    }
    return settled;
}

static void put(point_table *table, uint64_t id, const double at[3])
{
    octree_point point = {.id = id};
    memcpy(point.position, at, sizeof point.position);
    point_table_put(table, &point);
}

void change_make(const change *c, point_table *table)
{
    if (c->kind == OCTREE_EDIT_REMOVE)
        point_table_remove(table, c->id);
    else
        put(table, c->id, c->to);
}

void change_undo(const change *c, point_table *table)
{
    if (c->kind == OCTREE_EDIT_INSERT)
        point_table_remove(table, c->id);
    else
        put(table, c->id, c->from);
}
