/* SPDX-License-Identifier: MIT */
/* changes.h - how the points of one tick became those of the next. Private to this folder. */
#ifndef EMBED_CHANGES_H
#define EMBED_CHANGES_H

#include "points.h"

typedef struct change {
    octree_edit_kind kind;
    uint32_t order; /* changes_settle() alone reads it */
    uint64_t id;
    double from[3], to[3]; /* where it was and is; what does not apply is not read */
} change;

/* How one list became another, by id. Null: count them. Cost: O(both). */
size_t changes_between(const points *before, const points *after, change *changes);

/* Make of changes in the order in which they were made one for each id, or none where nothing came of them; by id.
 * Returns how many there are; `count` is at most UINT32_MAX. Cost: O(m log m). */
size_t changes_settle(change *changes, size_t count);

/* Make a change; there is room for it. */
void change_make(const change *c, point_table *table);
void change_undo(const change *c, point_table *table);

#endif
