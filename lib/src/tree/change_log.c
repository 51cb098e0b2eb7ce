/* SPDX-License-Identifier: MIT */
/* change_log.c - what changed in a tree's contents, for who follows it. */
#include "change_log.h"
#include "tree.h"

#include <string.h>

/* Of more changes than this share of the points, to look at the whole tree costs as much as to follow them. */
enum { LEAST_CHANGES = 1024, SHARE = 4 };

static uint64_t most_changes(const octree *tree)
{
    const uint64_t share = tree->root.count / SHARE;
    return share > LEAST_CHANGES ? share : LEAST_CHANGES;
}

void change_log_stop(change_log *log, arena *memory)
{
    atomic_store_explicit(&log->name, 0, memory_order_relaxed);
    arena_give(memory, log->items, log->room * sizeof *log->items);
    log->items = NULL;
    log->room = 0;
    log->first = ++log->next; /* no mark that was made before reaches it */
}

/* ---- Noting ------------------------------------------------------------------------------------------------- */

static bool grow(change_log *log, arena *memory)
{
    const size_t room = log->room ? 2 * log->room : 16;
    octree_change *items = arena_take(memory, room * sizeof *items); /* no overflow, as in list_append() */
    if (!items)
        return false;
    for (uint64_t i = log->first; i < log->next; i++)
        items[i & (room - 1)] = log->items[i & (log->room - 1)];
    arena_give(memory, log->items, log->room * sizeof *items);
    log->items = items;
    log->room = room;
    return true;
}

/* Room for one more. What was asked for may be overwritten, but not where that fills half of the room: so two who ask
 * in turn do not miss one another's changes. */
static bool make_room(change_log *log, arena *memory)
{
    if (log->next - log->first < log->room)
        return true;
    if (log->next - log->seen >= log->room / 2)
        return grow(log, memory);
    log->first++;
    return true;
}

static void add_change(octree *tree, const octree_change *made)
{
    change_log *log = &tree->changes;
    if (atomic_exchange_explicit(&log->asked, false, memory_order_relaxed))
        log->seen = log->next;
    if (log->next - log->seen < most_changes(tree) && make_room(log, &tree->store.memory))
        log->items[log->next++ & (log->room - 1)] = *made;
    else
        change_log_stop(log, &tree->store.memory);
}

/* ---- Changes made ------------------------------------------------------------------------------------------------ */

static size_t suspend(change_log *log)
{
    const size_t name = atomic_load_explicit(&log->name, memory_order_relaxed);
    atomic_store_explicit(&log->name, 0, memory_order_relaxed);
    return name;
}

static void resume(change_log *log, size_t name)
{
    atomic_store_explicit(&log->name, name, memory_order_relaxed);
}

static octree_status make_change(octree *tree, octree_change_kind kind, const double from[3], uint64_t id,
                                 const double to[3])
{
    switch (kind) {
    case OCTREE_INSERTED:
        return octree_insert(tree, to, id);
    case OCTREE_REMOVED:
        return octree_remove(tree, from, id);
    default:
        return octree_move(tree, from, id, to);
    }
}

octree_status change_log_single(octree *tree, octree_change_kind kind, const double from[3], uint64_t id,
                                const double to[3])
{
    octree_change made = {.kind = kind, .id = id}; /* a copy: the places may be the tree's own */
    if (from && kind != OCTREE_INSERTED)
        memcpy(made.from, from, sizeof made.from);
    if (to && kind != OCTREE_REMOVED)
        memcpy(made.to, to, sizeof made.to);
    const size_t name = suspend(&tree->changes);
    const octree_status status = make_change(tree, kind, from, id, to);
    resume(&tree->changes, name);
    if (status == OCTREE_OK)
        add_change(tree, &made);
    return status;
}

octree_status change_batch(octree *tree, octree_change_kind kind, const octree_point *points, const double (*to)[3],
                           size_t count, octree_status *statuses, size_t *done)
{
    switch (kind) {
    case OCTREE_INSERTED:
        return octree_insert_many(tree, points, count, statuses, done);
    case OCTREE_REMOVED:
        return octree_remove_many(tree, points, count, statuses, done);
    default:
        return octree_move_many(tree, points, to, count, statuses, done);
    }
}

static void note_batch(octree *tree, octree_change_kind kind, const octree_point *points, const double (*to)[3],
                       size_t count, const octree_status *statuses)
{
    for (size_t i = 0; i < count && change_log_is_on(&tree->changes); i++) {
        octree_change made = {.kind = kind, .id = points[i].id};
        if (kind != OCTREE_INSERTED)
            memcpy(made.from, points[i].position, sizeof made.from);
        if (kind != OCTREE_REMOVED)
            memcpy(made.to, kind == OCTREE_MOVED ? to[i] : points[i].position, sizeof made.to);
        if (statuses[i] == OCTREE_OK)
            add_change(tree, &made);
    }
}

octree_status change_log_batch(octree *tree, octree_change_kind kind, const octree_point *points, const double (*to)[3],
                               size_t count, octree_status *statuses, size_t *done)
{
    arena *memory = &tree->store.memory;
    const uint64_t version = tree->version;
    const bool few = points && count > 0 && count <= most_changes(tree);
    octree_status *own = few && !statuses ? arena_take(memory, count * sizeof *own) : NULL;
    octree_status *told = statuses ? statuses : own;
    const size_t name = suspend(&tree->changes);
    const octree_status status = change_batch(tree, kind, points, to, count, told, done);
    resume(&tree->changes, name);
    if (tree->version != version && few && told)
        note_batch(tree, kind, points, to, count, told);
    else if (tree->version != version)
        change_log_stop(&tree->changes, memory);
    arena_give(memory, own, count * sizeof *own);
    return status;
}

/* ---- Asking ------------------------------------------------------------------------------------------------- */

bool octree_changes_since(const octree *tree, size_t name, octree_mark *mark, octree_change_visitor visit,
                          void *context)
{
    if (!tree || !mark || !visit || name == 0)
        return false;
    /* Where const is cast away two atomic members are written, which no query reads. */
    change_log *log = (change_log *)(uintptr_t)&tree->changes;
    size_t own = 0;
    if (atomic_compare_exchange_strong(&log->name, &own, name))
        own = name;
    atomic_store(&log->asked, true);
    const octree_mark since = *mark;
    *mark = (octree_mark){own, log->next};
    if (since.log != own || since.at < log->first || since.at > log->next)
        return false;
    for (uint64_t i = since.at; i < log->next; i++)
        visit(&log->items[i & (log->room - 1)], context);
    return true;
}
