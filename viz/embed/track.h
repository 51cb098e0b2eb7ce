/* SPDX-License-Identifier: MIT */
/* track.h - follows the positions of a program's points, or their half extents, from tick to tick: the current value of
 * each id, and the changes since the last accepted tick. Private to viz/embed. */
#ifndef EMBED_TRACK_H
#define EMBED_TRACK_H

#include "batch.h"

/* There are two ways to find the changes of a tick:
 *
 * - Lists. All points are read into `next` and compared with `now`, in O(n). Comparing sorted lists takes a third of
 *   the time of looking up each point in a table.
 * - The table. Changes that the program passes, or that the tree's change log has, are applied to `table`, in
 *   O(changes). The table has the points of the tick that was read last.
 *
 * Either the lists or the table are in use; `tabled` is true for the table. A zero-initialized track has no points. */
typedef struct track {
    points now, next; /* the points before the tick that was read last, and the points of that tick */
    bool tabled;
    point_table table;
    change_list changes; /* changes since the last accepted tick, in the order in which they were made */
    size_t settled; /* the value of changes.count after all changes of a point were last combined into one change */
    size_t kept;    /* the value of changes.count before the tick that was read last */
} track;

void track_release(track *t);

/* Begin to read a tick. If the number of changes has doubled since they were last combined, combine the changes of each
 * point. Changes that cancel each other disappear, which limits memory while no tick is accepted. */
void track_begin_tick(track *t);

/* Revert the changes of the tick that was read last. */
void track_revert_tick(track *t);

/* Accept the tick that was read last. */
void track_accept_tick(track *t);

/* Switch from sorted lists to the table. Returns false if memory runs out. */
bool track_switch_to_table(track *t);

/* Switch from the table back to sorted lists: `now` becomes the list of points before the tick that is being read.
 * `spare` is scratch memory. Returns false if memory runs out. */
bool track_switch_to_lists(track *t, points *spare);

/* Change a point of the table from one value to another. A null `from` means that the point is inserted, a null `to`
 * that it is removed. Nothing changes if the two values are equal. Returns false if memory runs out. */
bool track_change_point(track *t, uint64_t id, const double *from, const double *to);

/* Add the changes from the list `now` to the list `next`. Where many changes are likely, room for one change of each
 * point is reserved at once. Returns false if memory runs out. */
bool track_compare_lists(track *t, bool many_changes);

#endif
