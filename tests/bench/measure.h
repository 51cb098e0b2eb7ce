/* SPDX-License-Identifier: MIT */
/* measure.h - times one operation on several trees in turn, and compares their answers. */
#ifndef BENCH_MEASURE_H
#define BENCH_MEASURE_H

#include "workload.h"

enum { ROUNDS_AT_MOST = 99, RIVALS_AT_MOST = 16 };

/* A tree that takes part in an operation. */
typedef struct contender {
    const char *who;
    const peer *peer;
    void *self;
    peer_ask ask;  /* null for changes */
    size_t points; /* number of points in the tree, before and after the operation */
    double ns;     /* time of an operation: the median of the rounds */
    size_t memory; /* bytes of the tree with these points */
    double round_ns[ROUNDS_AT_MOST];
} contender;

/* The contenders of an operation; the others are compared with the first. */
typedef struct lineup {
    contender of[RIVALS_AT_MOST];
    int count;
} lineup;

typedef enum outcome { MEASURED, UNLIKE, OUT_OF_MEMORY } outcome;

/* Changes to time. PEER_BUILD and PEER_INSERT make the tree anew; after other changes the tree is restored. */
typedef struct changes {
    const char *op; /* name of the operation in messages */
    peer_change_kind kind;
    const octree_point *points, *to; /* `to` is only used by moves */
    size_t count;
} changes;

typedef struct questions {
    const char *op;
    const peer_query *queries;
    size_t count;
    bool cold; /* empty the caches before each tree is asked */
} questions;

/* Compare answers with those of the first contender. UNLIKE: stderr says what differs. */
outcome measure_compare(const lineup *l, int i, const char *op, const workload *w, size_t count,
                        const peer_answer *expected, const peer_answer *given);

/* Time all contenders in turn, `rounds` times. UNLIKE: stderr says what differs. */
outcome measure_changes(lineup *l, const workload *w, const changes *asked, int rounds);
outcome measure_asks(lineup *l, const workload *w, const questions *asked, int rounds);

#endif
