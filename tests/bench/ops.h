/* SPDX-License-Identifier: MIT */
/* ops.h - the operations of the bench, and the trees on which each is measured. */
#ifndef BENCH_OPS_H
#define BENCH_OPS_H

#include "batches.h"

/* Which trees an operation needs. */
typedef enum stage {
    STAGE_FILL,    /* no tree exists yet: the operation makes it */
    STAGE_DYNAMIC, /* filled point by point */
    STAGE_STATIC,  /* built at once */
    STAGE_CHURNED, /* only octrees: half of the points were removed, or never inserted */
    STAGE_BATCHES, /* octrees, and a grid that is rebuilt: each operation makes and frees it */
    STAGE_TUNED,   /* only octrees: one that chooses its capacity for the operations, and all capacities */
    STAGES
} stage;

typedef struct goal {
    enum { NO_GOAL, AT_LEAST, AT_MOST } kind;
    double ratio; /* time of the fastest other tree divided by the octree's */
} goal;

typedef struct op {
    const char *name;
    stage stage;
    peer_change_kind change; /* used in STAGE_FILL and STAGE_DYNAMIC */
    peer_ask_kind ask;       /* used in the other stages */
    size_t most;             /* queries at most */
    size_t hits;             /* > 0: targets are sized to find this many */
    bool stored;             /* query positions of points instead of targets */
    bool sorted;             /* query the targets in Morton order, as neighbours are queried in a batch */
    bool cold;               /* empty the caches before each tree is asked */
    bool far;                /* move to a far place */
    const char *rival;       /* not null: the octree is compared with itself, under this name and ... */
    peer_ask_kind rival_ask; /* ... with this query */
    batch_kind batch;        /* STAGE_BATCHES: the change of ... */
    size_t percent;          /* ... this share of the points */
    octree_mix mix;          /* STAGE_TUNED: the operations for which the capacity is chosen */
    goal goal;
    const char *note; /* why there is no goal, or when another choice is better; may be null */
} op;

enum { OPS = 39 };

extern const op all_ops[OPS];

/* Called with the results of an operation. */
typedef void report_op(const op *o, const workload *w, const lineup *l, void *context);

/* Measure the operations for which wanted[i] is set on a workload. */
outcome run_ops(const bool wanted[OPS], workload *w, int rounds, report_op *report, void *context);

#endif
