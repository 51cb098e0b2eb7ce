/* SPDX-License-Identifier: MIT */
/* workload.h - the workload, the same for every tree: one set of points, changes to it, and targets of queries. */
#ifndef BENCH_WORKLOAD_H
#define BENCH_WORKLOAD_H

#include "octree/sample.h"
#include "peer.h"

typedef struct workload {
    const char *name; /* of the set of points */
    octree_box world;
    size_t count;
    octree_point *points; /* in random order; ids are places */
    octree_point *picks;  /* the points again, in another random order: the first half is what is changed */
    size_t half;
    octree_point *near, *far; /* where the first picks move to: one mean spacing away, to a place like the others */
    peer_query *stored;       /* the places of the first picks */
    peer_query *targets;      /* places of the same distribution (for a lattice: anywhere) where no point is */
    peer_query *sorted;       /* some of the targets, in Morton order and without a size */
    size_t query_count;       /* of near, far, stored and targets */
} workload;

enum { POINTS_AT_LEAST = 100, POINTS_AT_MOST = 100000000 };

/* Points to measure instead of a sample: rows of coordinates. */
typedef struct point_file {
    const char *name;
    double (*rows)[3];
    size_t count;
} point_file;

/* Read a file of lines that begin with three numbers, such as an .xyz file. Shuffle the points, and scale them to the
 * world of the bench. Ends the program with an error if the file cannot be read. */
point_file read_point_file(const char *path);

/* Make the workload of a sample or, if `file` is not null, of points of the file. False when there is no memory; it is
 * then empty. */
bool workload_make(workload *w, octree_sample_kind set, const point_file *file, size_t count);
void workload_free(workload *w);

/* Where a point goes that moves by one mean spacing, within the world. */
octree_point workload_step(const workload *w, const octree_point *from, uint64_t *random);

/* Give every target the size at which `ask` of the octree finds `hits` points in the mean (half of all at most).
 * False when there is no memory. */
bool workload_size_targets(workload *w, peer_ask_kind ask, size_t hits);

#endif
