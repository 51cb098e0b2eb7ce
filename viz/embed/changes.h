/* SPDX-License-Identifier: MIT */
/* changes.h - the changes of points from one tick to the next. Private to this folder. */
#ifndef EMBED_CHANGES_H
#define EMBED_CHANGES_H

#include "points.h"

typedef struct change {
    octree_edit_kind kind;
    uint32_t order; /* used by changes_settle() only */
    uint64_t id;
    double from[3], to[3]; /* positions; an insertion has no `from`, a removal no `to` */
} change;

/* Find the changes from one list to another, by id. Returns their count; with null `changes` it only counts.
 * Cost: O(before + after). */
size_t changes_between(const points *before, const points *after, change *changes);

/* Reduce changes in the order in which they were made to one for each id, sorted by id. Changes that cancel out vanish.
 * Returns the new count; `count` is at most UINT32_MAX. Cost: O(m log m). */
size_t changes_settle(change *changes, size_t count);

/* Apply a change to a table, or revert it. The table has room for one more point. */
void change_make(const change *c, point_table *table);
void change_undo(const change *c, point_table *table);

#endif
