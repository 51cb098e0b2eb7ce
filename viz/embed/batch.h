/* SPDX-License-Identifier: MIT */
/* batch.h - holds one tick of a program until it is recorded: the point changes since the tick before, the queries, the
 * shapes, the foreign nodes and pairs, and the gaps before the tick. Private to viz/embed. */
#ifndef EMBED_BATCH_H
#define EMBED_BATCH_H

#include "octreel/recorder.h"
#include "points.h"

/* A batch has the changes of two tracks: of the points' positions, and of their half extents. Points without extents
 * are not on the second track. Half extents are three numbers for an id, as positions are, so the same functions and
 * structures follow both: on the track EXTENTS, the `position` of a point is its half extents. A program whose points
 * have no extents pays nothing for them. */
enum { POSITIONS, EXTENTS, TRACKS };

typedef struct change {
    octree_edit_kind kind;
    /* the change's position in the sequence in which the program made its changes; only combine_changes() uses it */
    uint32_t order;
    uint64_t id;
    double from[3], to[3]; /* positions before and after the change; an insertion has no `from`, a removal no `to` */
} change;

typedef struct change_list {
    change *items;
    size_t count, room;
} change_list;

void change_list_release(change_list *list);

/* The comparison of two lists of points by id: the changes that turn the list `before` into the list `after`. `i` and
 * `j` are the indices of the first points that are not compared yet. */
typedef struct list_comparison {
    const points *before, *after;
    size_t i, j;
} list_comparison;

/* List the next changes, at most `most`. Returns the number of changes. Cost: O(compared points). */
size_t list_next_changes(list_comparison *lists, change *changes, size_t most);

/* Returns whether all points of both lists have been compared. */
bool list_comparison_has_ended(const list_comparison *lists);

/* Combine all changes of a point into one change, and sort the changes by id. Before the call, the changes must be in
 * the order in which the program made them. Changes that cancel each other are removed. Returns the new number of
 * changes. `count` may be at most UINT32_MAX. Cost: O(m log m) for m changes. */
size_t combine_changes(change *changes, size_t count);

/* Set *made to the change of a point from position `from` to position `to`. If `from` is null, the change is an
 * insertion; if `to` is null, it is a removal. Returns false if the two positions are equal, because then nothing
 * changes. */
bool change_make(uint64_t id, const double *from, const double *to, change *made);

/* Apply a change to a table of points, or revert the change. The table must have room for one more point. */
void change_apply(const change *c, point_table *table);
void change_revert(const change *c, point_table *table);

/* Apply all changes to a table, which must have room for their insertions. */
void change_list_apply(const change_list *list, point_table *table);

/* A run of consecutive refused ticks with the same reason. */
typedef struct gap_run {
    uint64_t ticks;
    char why[OCTREE_GAP_TEXT];
} gap_run;

/* The ticks that were refused since the last accepted tick. Consecutive ticks with the same reason form one run. When
 * the list has MOST_GAP_RUNS runs, further ticks are added to the last run, whatever their reason. */
#define MOST_GAP_RUNS 32
typedef struct gap_list {
    gap_run runs[MOST_GAP_RUNS];
    size_t count;
} gap_list;

void gap_list_add(gap_list *list, const char *why);
uint64_t gap_list_count_ticks(const gap_run *runs, size_t count);

/* An accepted tick, and the ticks that were refused before it, called gaps. If is_gap is true, the batch has only
 * gaps. */
typedef struct batch {
    struct batch *next;
    gap_run *gaps; /* the refused ticks before the accepted tick */
    size_t gap_count;
    bool is_gap; /* true: the batch has gaps but no tick */
    /* the changes of the tick on each track, in the order in which the program made them; batch_combine_changes() sorts
     * them by id */
    change_list changes[TRACKS];
    octree_query *queries;
    size_t query_count;
    octree_shape *shapes;
    size_t shape_count;
    /* true: the tick has new foreign nodes; false: the foreign nodes of the previous tick stay valid */
    bool has_foreign;
    octree_foreign_tree foreign;
    bool has_pairs; /* true: the program's index found `pairs` at this tick */
    octree_foreign_pairs pairs;
    size_t bytes; /* memory that the batch uses, in bytes */
} batch;

/* Make a batch with an accepted tick that has no changes yet. The gaps, queries, shapes, foreign nodes and
 * foreign pairs are copied. `about` and `foreign` may be null. Returns null if memory runs out. Cost: O(gaps + queries
 * + shapes + nodes + pairs). */
batch *batch_make(const gap_list *gaps, const octreel_tick_info *about, const octree_foreign_tree *foreign);

/* Combine all changes of a point on a track into one change, and sort the changes by id. */
void batch_combine_changes(batch *b);

/* Make a batch that has gaps but no tick. Returns null if memory runs out. */
batch *batch_make_gaps(const gap_list *gaps);
void batch_release(batch *b);

/* A linked list of batches. */
typedef struct batch_list {
    batch *first, *last;
    size_t count, bytes;
} batch_list;

void batch_list_add(batch_list *list, batch *b);
/* Remove the first batch from the list and return it; the caller then owns it. Returns null if the list is empty. */
batch *batch_list_remove_first(batch_list *list);
void batch_list_clear(batch_list *list);

#endif
