/* SPDX-License-Identifier: MIT */
/* batch.h - one tick of a program on its way to the file: its point changes since the tick before, its queries, shapes
 * and foreign nodes, and the gaps before it. Private to this folder. */
#ifndef EMBED_BATCH_H
#define EMBED_BATCH_H

#include "octreel/recorder.h"
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

/* Make the change of a point from one position to another; null: the point does not exist there. False if nothing
 * changes. */
bool change_make(uint64_t id, const double *from, const double *to, change *made);

/* Apply a change to a table, or revert it. The table has room for one more point. */
void change_apply(const change *c, point_table *table);
void change_revert(const change *c, point_table *table);

/* Consecutive refused ticks with the same reason. */
typedef struct gap_run {
    uint64_t ticks;
    char why[OCTREE_GAP_TEXT];
} gap_run;

/* All ticks that were refused since the last accepted one. When the runs are full, further ticks join the last run. */
#define MOST_GAP_RUNS 32
typedef struct gap_list {
    gap_run runs[MOST_GAP_RUNS];
    size_t count;
} gap_list;

void gap_list_add(gap_list *list, const char *why);
uint64_t gap_list_ticks(const gap_run *runs, size_t count);

/* One tick, or gaps alone. */
typedef struct batch {
    struct batch *next;
    gap_run *gaps; /* before the tick */
    size_t gap_count;
    bool is_gap;     /* holds only the gaps */
    change *changes; /* in the order in which they were made, until batch_settle() */
    size_t change_count;
    octree_query *queries;
    size_t query_count;
    octree_shape *shapes;
    size_t shape_count;
    bool has_foreign; /* the tick has foreign nodes; else those of the tick before stay */
    octree_foreign_tree foreign;
    size_t bytes; /* memory of the batch */
} batch;

/* Make a tick without changes, from copies of the gaps, queries, shapes and foreign nodes; `about` and `foreign` may be
 * null. Null if out of memory. Cost: O(gaps + queries + shapes + nodes). */
batch *batch_make(const gap_list *gaps, const octreel_tick_info *about, const octree_foreign_tree *foreign);

/* Reduce the changes to one for each id, sorted by id. */
void batch_settle(batch *b);

/* Make a batch of gaps alone. Null if out of memory. */
batch *batch_make_gaps(const gap_list *gaps);
void batch_release(batch *b);

/* A linked list of batches. */
typedef struct batch_list {
    batch *first, *last;
    size_t count, bytes;
} batch_list;

void batch_list_add(batch_list *list, batch *b);
batch *batch_list_take(batch_list *list); /* the first, which the caller then owns; null if empty */
void batch_list_clear(batch_list *list);

#endif
