/* SPDX-License-Identifier: MIT */
/* change_log.c - the recent changes of a tree's contents, for programs that follow a tree.
 *
 * Problem: a program that mirrors a tree (a picture, a cache) must learn which points changed without comparing all of
 * them. Readers run on many threads, are not registered, and may stop reading at any time.
 *
 * Idea: a ring of the last changes, numbered from 0 on. A reader keeps a cursor, which is the name of a log and the
 * number of the next change to read. The log starts with the first read. The log stops by itself when so many changes
 * are unread that reading the whole tree would cost less. So the tree holds no list of readers. In a tree without
 * readers, each change costs one test of an atomic variable.
 *
 * Cost: one write to the ring per change. The ring doubles when the unread changes fill half of it.
 */
#include "change_log.h"
#include "tree.h"

#include <string.h>

/* The log stops when the number of unread changes reaches a quarter (1 / SHARE) of the number of points: then reading
 * the changes would cost at least as much as reading the whole tree. The log of a small tree keeps at least
 * LEAST_CHANGES changes. */
enum { LEAST_CHANGES = 1024, SHARE = 4 };

uint64_t change_log_limit(const octree *tree)
{
    const uint64_t share = tree->root.count / SHARE;
    return share > LEAST_CHANGES ? share : LEAST_CHANGES;
}

void change_log_stop(change_log *log, arena *memory)
{
    atomic_store_explicit(&log->name, 0, memory_order_relaxed);
    arena_free(memory, log->items, log->room * sizeof *log->items);
    log->items = NULL;
    log->room = 0;
    /* the number of the next change is raised by one, so that all older cursors become invalid */
    log->first = ++log->next;
}

/* ---- Writing ------------------------------------------------------------------------------------------------ */

static bool grow_ring(change_log *log, arena *memory)
{
    const size_t room = log->room ? 2 * log->room : 16;
    /* The product cannot overflow, because no allocation is larger than PTRDIFF_MAX. */
    octree_change *items = arena_allocate(memory, room * sizeof *items);
    if (!items)
        return false;
    for (uint64_t i = log->first; i < log->next; i++)
        items[i & (room - 1)] = log->items[i & (log->room - 1)];
    arena_free(memory, log->items, log->room * sizeof *items);
    log->items = items;
    log->room = room;
    return true;
}

/* Make room for one more change. Changes that were read may be overwritten only while the unread changes fill less than
 * half of the ring. So a second reader that is behind the first reader usually still finds the changes that it has not
 * read. */
static bool make_room_for_change(change_log *log, arena *memory)
{
    if (log->next - log->first < log->room)
        return true;
    if (log->next - log->last_read >= log->room / 2)
        return grow_ring(log, memory);
    log->first++;
    return true;
}

void change_log_append(octree *tree, octree_change_kind kind, const octree_point *old, const double to[3])
{
    change_log *log = &tree->changes;
    octree_change made = {.kind = kind, .id = old->id};
    if (kind != OCTREE_INSERTED)
        memcpy(made.from, old->position, sizeof made.from);
    if (kind != OCTREE_REMOVED)
        memcpy(made.to, to, sizeof made.to);
    if (atomic_exchange_explicit(&log->was_read, false, memory_order_relaxed))
        log->last_read = log->next;
    if (log->next - log->last_read < change_log_limit(tree) && make_room_for_change(log, &tree->store.memory))
        log->items[log->next++ & (log->room - 1)] = made;
    else
        change_log_stop(log, &tree->store.memory);
}

/* ---- Reading ------------------------------------------------------------------------------------------------ */

bool octree_changes_since(const octree *tree, size_t log_name, octree_cursor *cursor, octree_change_visitor visit,
                          void *context)
{
    if (!tree || !cursor || !visit || log_name == 0)
        return false;
    /* The cast removes const, to write two atomic members of the log that no query reads. */
    change_log *log = (change_log *)(uintptr_t)&tree->changes;
    size_t name = 0;
    if (atomic_compare_exchange_strong(&log->name, &name, log_name))
        name = log_name;
    atomic_store(&log->was_read, true);
    const octree_cursor since = *cursor;
    *cursor = (octree_cursor){name, log->next};
    if (since.log != name || since.position < log->first || since.position > log->next)
        return false;
    const unsigned begun = begin_callbacks(tree);
    for (uint64_t i = since.position; i < log->next; i++)
        visit(&log->items[i & (log->room - 1)], context);
    end_callbacks(begun);
    return true;
}
