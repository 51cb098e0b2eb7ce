/* SPDX-License-Identifier: MIT */
/* change_log.h - the recent changes of a tree's contents, read through octree_changes_since().
 *
 * The log is off until the first read. The log turns off again after too many unread changes, when memory runs out, and
 * after an operation that replaces all nodes. While the log is off, octree_changes_since() returns false.
 */
#ifndef OCTREE_CHANGE_LOG_H
#define OCTREE_CHANGE_LOG_H

#include "octree/octree.h"
#include "pool.h"

#include <stdatomic.h>

typedef struct change_log {
    /* Readers write these two members, while other readers and queries may run on other threads. */
    atomic_size_t name;   /* the name that the first reader gave to the log; 0: the log is off */
    atomic_bool was_read; /* true: a reader has read the log since the last change */
    /* Only changes of the tree write the other members. Changes are numbered from 0 on. The change with number i is
     * items[i % room]. */
    uint64_t first, next; /* first: the number of the oldest stored change; next: the number of the next change */
    uint64_t last_read;   /* the value of `next` when a reader last read the log */
    octree_change *items;
    size_t room; /* the length of the array `items`: 0, or a power of two */
} change_log;

static inline bool change_log_is_on(const change_log *log)
{
    return atomic_load_explicit(&log->name, memory_order_relaxed) != 0;
}

/* Log a change that was made. `old` is the point before a move or a removal, or the inserted point. `to` is the
 * position after a move or an insertion; it is not read for a removal. Neither pointer may point into the tree's
 * memory. */
void change_log_append(octree *tree, octree_change_kind kind, const octree_point *old, const double to[3]);

/* Returns the number of unread changes at which the log stops, because reading so many changes would cost at least as
 * much as reading the whole tree. */
uint64_t change_log_limit(const octree *tree);

/* Discard all changes and turn the log off. */
void change_log_stop(change_log *log, arena *memory);

#endif
