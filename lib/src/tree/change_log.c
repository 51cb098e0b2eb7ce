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
    octree_change *items = room <= SIZE_MAX / sizeof *items ? arena_take(memory, room * sizeof *items) : NULL;
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

void change_log_add(octree *tree, octree_change_kind kind, uint64_t id, const double from[3], const double to[3])
{
    change_log *log = &tree->changes;
    if (atomic_exchange_explicit(&log->asked, false, memory_order_relaxed))
        log->seen = log->next;
    if (log->next - log->seen >= most_changes(tree) || !make_room(log, &tree->store.memory)) {
        change_log_stop(log, &tree->store.memory);
        return;
    }
    octree_change *c = &log->items[log->next++ & (log->room - 1)];
    *c = (octree_change){.kind = kind, .id = id};
    if (kind != OCTREE_INSERTED)
        memcpy(c->from, from, sizeof c->from);
    if (kind != OCTREE_REMOVED)
        memcpy(c->to, to, sizeof c->to);
}

/* ---- Batches ------------------------------------------------------------------------------------------------ */

static octree_status make_batch(octree *tree, octree_change_kind kind, const octree_point *points,
                                const double (*to)[3], size_t count, octree_status *statuses, size_t *done)
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
    for (size_t i = 0; i < count && change_log_is_on(&tree->changes); i++)
        if (statuses[i] == OCTREE_OK)
            change_log_add(tree, kind, points[i].id, points[i].position,
                           kind == OCTREE_MOVED ? to[i] : points[i].position);
}

octree_status change_log_batch(octree *tree, octree_change_kind kind, const octree_point *points, const double (*to)[3],
                               size_t count, octree_status *statuses, size_t *done)
{
    change_log *log = &tree->changes;
    arena *memory = &tree->store.memory;
    const size_t name = atomic_load_explicit(&log->name, memory_order_relaxed);
    const uint64_t version = tree->version;
    octree_status *own = NULL;
    if (!statuses && count > 0 && count <= most_changes(tree))
        own = arena_take(memory, count * sizeof *own);
    octree_status *told = statuses ? statuses : own;
    atomic_store_explicit(&log->name, 0, memory_order_relaxed);
    const octree_status status = make_batch(tree, kind, points, to, count, told, done);
    atomic_store_explicit(&log->name, name, memory_order_relaxed);
    if (tree->version != version && told && count <= most_changes(tree))
        note_batch(tree, kind, points, to, count, told);
    else if (tree->version != version)
        change_log_stop(log, memory);
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
