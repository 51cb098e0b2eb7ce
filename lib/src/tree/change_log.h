/* SPDX-License-Identifier: MIT */
/* change_log.h - the last changes of a tree's contents, while somebody asks for them (octree_changes_since). Off until
 * then, and off again when nobody has asked for long, when memory is short, and after what changes everything: who asks
 * next is told that the changes are not known. */
#ifndef OCTREE_CHANGE_LOG_H
#define OCTREE_CHANGE_LOG_H

#include "octree/octree.h"
#include "pool.h"

#include <stdatomic.h>

typedef struct change_log {
    /* Two that are set by who asks, beside others that ask or read the tree: */
    atomic_size_t name; /* of who asked first; 0: off */
    atomic_bool asked;  /* since the last change */
    /* and those that change with the tree. Changes are numbered from 0 on; number i is at items[i % room]. */
    uint64_t first, next; /* the oldest that is kept, and the next to come */
    uint64_t seen;        /* the next to come when it was asked for last */
    octree_change *items;
    size_t room; /* 0, or a power of two */
} change_log;

static inline bool change_log_is_on(const change_log *log)
{
    return atomic_load_explicit(&log->name, memory_order_relaxed) != 0;
}

/* Make a change of this kind by octree_insert(), octree_remove() or octree_move(), which find the log off meanwhile,
 * and note it. What has one place alone is given it twice. */
octree_status change_log_single(octree *tree, octree_change_kind kind, const double from[3], uint64_t id,
                                const double to[3]);

/* A batch by octree_insert_many() or its like; and the same with the log off meanwhile, after which it is noted. */
octree_status change_batch(octree *tree, octree_change_kind kind, const octree_point *points, const double (*to)[3],
                           size_t count, octree_status *statuses, size_t *done);
octree_status change_log_batch(octree *tree, octree_change_kind kind, const octree_point *points, const double (*to)[3],
                               size_t count, octree_status *statuses, size_t *done);

/* Let all that was noted be forgotten. */
void change_log_stop(change_log *log, arena *memory);

#endif
