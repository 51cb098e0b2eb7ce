/* SPDX-License-Identifier: MIT */
/* batch.h - what a program handed over in a tick, as the change since the tick before, and the gaps between. Private to
 * this folder. */
#ifndef EMBED_BATCH_H
#define EMBED_BATCH_H

#include "changes.h"

/* Ticks in a row that were refused, for one reason. */
typedef struct gap_run {
    uint64_t ticks;
    char why[OCTREE_GAP_TEXT];
} gap_run;

/* Runs in a row: all that was refused since the last tick that was taken. What comes after the last run that there is
 * room for counts as of its reason. */
#define MOST_GAP_RUNS 32
typedef struct gap_list {
    gap_run runs[MOST_GAP_RUNS];
    size_t count;
} gap_list;

void gap_list_add(gap_list *list, const char *why);
uint64_t gap_list_ticks(const gap_run *runs, size_t count);

/* What a program handed over in a tick, as the change since the tick before. */
typedef struct batch {
    struct batch *next;
    gap_run *gaps; /* before the tick */
    size_t gap_count;
    bool is_gap;     /* there is nothing but those */
    change *changes; /* by id, one for each; */
    bool unsettled;  /* or as they were made, for batch_settle() */
    size_t change_count;
    octree_query *queries;
    size_t query_count;
    octree_shape *shapes;
    size_t shape_count;
    bool has_foreign; /* the nodes of the program's tree are said in the tick; else they are as before */
    octree_foreign_tree foreign;
    size_t bytes; /* of all of it */
} batch;

/* A tick with copies of the gaps before it, of the queries, the shapes and the nodes, and as yet without changes;
 * `about` and `foreign` may be null. Null when there is no memory. Cost: O(gaps, queries, shapes, nodes). */
batch *batch_make(const gap_list *gaps, const octreel_tick_info *about, const octree_foreign_tree *foreign);

/* Let there be one change for each id. */
void batch_settle(batch *b);

/* The gaps alone. */
batch *batch_make_gaps(const gap_list *gaps);
void batch_release(batch *b);

/* Batches in a row. */
typedef struct batch_list {
    batch *first, *last;
    size_t count, bytes;
} batch_list;

void batch_list_add(batch_list *list, batch *b);
batch *batch_list_take(batch_list *list); /* the first, which is the caller's; null where there is none */
void batch_list_clear(batch_list *list);

#endif
