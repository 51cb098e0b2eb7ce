/* batch.h - what a program handed over in a tick, as the change since the tick before. Private to this folder. */
#ifndef EMBED_BATCH_H
#define EMBED_BATCH_H

#include "points.h"

typedef struct change {
    octree_edit_kind kind;
    uint64_t id;
    double from[3], to[3]; /* where it was and is; what does not apply is not read */
} change;

typedef struct batch {
    struct batch *next;
    change *changes; /* removals, then moves, then insertions, each by id */
    size_t change_count;
    octree_query *queries;
    size_t query_count;
    octree_shape *shapes;
    size_t shape_count;
    size_t bytes; /* of all of it */
} batch;

/* How the points of one tick became those of the next, with copies of the queries and shapes; `about` may be null. Null
 * when there is no memory. Cost: O(both, queries, shapes). */
batch *batch_make(const points *before, const points *after, const octreel_tick_info *about);
void batch_release(batch *b);

/* Make the changes of a batch; `spare` is used meanwhile. False when there is no memory. */
bool batch_apply(const batch *b, points *p, points *spare);

#endif
