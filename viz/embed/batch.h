/* SPDX-License-Identifier: MIT */
/* batch.h - one tick of a program on its way to the file: its point changes since the tick before, its queries, shapes
 * and foreign nodes, and the gaps before it. Private to this folder. */
#ifndef EMBED_BATCH_H
#define EMBED_BATCH_H

#include "changes.h"

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
    change *changes; /* one for each id, in ascending order of ids */
    bool unsettled;  /* the changes are still in the order in which they were made: call batch_settle() */
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

/* Reduce the changes to one for each id. */
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
