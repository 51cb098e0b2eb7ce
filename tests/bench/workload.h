/* SPDX-License-Identifier: MIT */
/* workload.h - the workload, the same for every tree: one set of points, changes to it, and targets of queries. */
#ifndef BENCH_WORKLOAD_H
#define BENCH_WORKLOAD_H

#include "octree/sample.h"
#include "peer.h"

typedef struct workload {
    octree_sample_kind set;
    octree_box world;
    size_t count;
    octree_point *points; /* in random order; ids are places */
    octree_point *picks;  /* the points again, in another random order: the first half is what is changed */
    size_t half;
    octree_point *near, *far; /* where the first picks move to: one mean spacing away, to a place like the others */
    peer_query *stored;       /* the places of the first picks */
    peer_query *targets;      /* places of the same distribution (for a lattice: anywhere) where no point is */
    size_t query_count;       /* of near, far, stored and targets */
} workload;

/* Make the workload of a set. False when there is no memory; it is then empty. */
bool workload_make(workload *w, octree_sample_kind set, size_t count);
void workload_free(workload *w);

/* Where a point goes that moves by one mean spacing, within the world. */
octree_point workload_step(const workload *w, const octree_point *from, uint64_t *random);

/* Give every target the size at which `ask` of the octree finds `hits` points in the mean (half of all at most).
 * False when there is no memory. */
bool workload_size_targets(workload *w, peer_ask_kind ask, size_t hits);

#endif
