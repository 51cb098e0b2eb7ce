/* SPDX-License-Identifier: MIT */
/* batches.h - measures the changes of one game tick: by one call, in a loop, and by building the tree anew. */
#ifndef BENCH_BATCHES_H
#define BENCH_BATCHES_H

#include "measure.h"

typedef enum batch_kind {
    BATCH_INSERT,
    BATCH_REMOVE,
    BATCH_MOVE,  /* a share of the points moves by one mean spacing; the first round is the first call on a tree */
    BATCH_FRAME, /* a share of the points moves by one mean spacing; 1000 boxes and 1000 nearest points are asked for */
} batch_kind;

/* Time batches of this share of the points, in percent. Sets the lineup: nanoseconds are those of a point, of a frame
 * those of the whole. */
outcome measure_batches(lineup *l, workload *w, const char *op, batch_kind kind, size_t percent, int rounds);

#endif
