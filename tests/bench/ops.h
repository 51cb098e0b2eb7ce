/* SPDX-License-Identifier: MIT */
/* ops.h - the operations of the bench, and the trees on which each is measured. */
#ifndef BENCH_OPS_H
#define BENCH_OPS_H

#include "batches.h"

/* Which trees an operation needs. */
typedef enum stage {
    STAGE_FILL,    /* none: it makes them */
    STAGE_DYNAMIC, /* filled point by point */
    STAGE_STATIC,  /* built at once */
    STAGE_CHURNED, /* octrees alone: half of the points are removed again, or were never there */
    STAGE_BATCHES, /* octrees, and a grid that is built anew: made and freed by each operation */
    STAGE_TUNED,   /* octrees alone: one that chooses its capacity by the operation's mix, and all capacities */
    STAGES
} stage;

typedef struct goal {
    enum { NO_GOAL, AT_LEAST, AT_MOST } kind;
    double ratio; /* of the best other's time to the octree's */
} goal;

typedef struct op {
    const char *name;
    stage stage;
    peer_change_kind change; /* read in STAGE_FILL and STAGE_DYNAMIC */
    peer_ask_kind ask;       /* read in the other stages */
    size_t most;             /* queries at most */
    size_t hits;             /* > 0: targets are sized to find this many */
    bool stored;             /* ask for places where points are, not for targets */
    bool far;                /* move to a far place */
    const char *rival;       /* not null: the octree against itself, under this name and ... */
    peer_ask_kind rival_ask; /* ... asked like this */
    batch_kind batch;        /* STAGE_BATCHES: what is done to ... */
    size_t percent;          /* ... this share of the points */
    octree_mix mix;          /* STAGE_TUNED: what the capacity is chosen for */
    goal goal;
    const char *note; /* may be null: when something else is the better choice, or why there is no goal */
} op;

enum { OPS = 29 };

extern const op all_ops[OPS];

/* Told the results of an operation. */
typedef void report_op(const op *o, const workload *w, const lineup *l, void *context);

/* Measure those operations of which wanted[i] is set on a workload. */
outcome run_ops(const bool wanted[OPS], workload *w, int rounds, report_op *report, void *context);

#endif
