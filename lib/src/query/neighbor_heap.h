/* SPDX-License-Identifier: MIT */
/* neighbor_heap.h - the k nearest neighbours found so far, compared exactly. Private.
 *
 * Up to 32 neighbours are kept in order, more in a heap. Squared distances in doubles decide when their proven error
 * allows it (metric.h); otherwise exact arithmetic decides. So rounding never selects a neighbour.
 */
#ifndef OCTREE_NEIGHBOR_HEAP_H
#define OCTREE_NEIGHBOR_HEAP_H

#include "metric.h"

#include <stddef.h>

/* Up to 32 neighbours in numbered slots. A key is a neighbour's square whose lowest FEW_BITS bits hold its slot. Keys
 * ascend, except that the last of k keys belongs to the neighbour that is farthest by exact comparison. */
#define FEW_BITS 5
#define FEW_NEIGHBORS (1 << FEW_BITS)
/* Index of the first key. The smaller sentinels before it let pairwise insertion run past the start. */
#define FEW_FIRST 3
typedef struct few_neighbors {
    double keys[FEW_FIRST + FEW_NEIGHBORS];
    double squares[FEW_NEIGHBORS]; /* indexed by slot, like `points` */
    const octree_point *points[FEW_NEIGHBORS];
} few_neighbors;

typedef struct neighbor_heap {
    metric metric;
    octree_search how;
    double radius; /* negative: the distance is not limited */
    double radius_square;
    double shrink;      /* 1 / (1 + epsilon)^2, rounded up: nodes are pruned beyond the farthest square times this */
    double point_reach; /* a point with a greater square is not among the k nearest */
    double node_reach;  /* a node with a greater square contains none of the k nearest */
    octree_neighbor *items; /* the caller's array; `distance` holds scaled squares until the end */
    size_t count, k;
    few_neighbors few; /* used instead of `items` until the end if k <= FEW_NEIGHBORS */
} neighbor_heap;

/* Start a search. h->metric is already set; radius < 0 means no limit; `room` holds k neighbours. */
void neighbor_heap_begin(neighbor_heap *h, const octree_search *how, double radius, octree_neighbor *room, size_t k);

/* The square beyond which points are not among the k nearest, given that a point with the square `square` exists. */
static inline double neighbor_heap_reach(const neighbor_heap *h, double square)
{
    const double reach = metric_above(square);
    return h->k == 1 && h->how.skip == OCTREE_SKIP_NONE && reach < h->point_reach ? reach : h->point_reach;
}

/* Offer a point whose square is not above point_reach. It is kept if it is not skipped and is among the k nearest. */
void neighbor_heap_add(neighbor_heap *h, const octree_point *point, double square);

/* Sort the neighbours by distance, id and position, and replace squares by distances. */
void neighbor_heap_finish(neighbor_heap *h);

#endif
