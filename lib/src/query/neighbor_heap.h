/* SPDX-License-Identifier: MIT */
/* neighbor_heap.h - the k nearest neighbours found so far, decided by the real numbers. Private.
 *
 * Few are kept in order; more in a heap in the caller's array, the farthest on top. Squared distances in doubles decide
 * whenever their proven error allows (metric.h), exact arithmetic decides the rest: so rounding never picks a
 * neighbour.
 */
#ifndef OCTREE_NEIGHBOR_HEAP_H
#define OCTREE_NEIGHBOR_HEAP_H

#include "metric.h"

#include <stddef.h>

/* Up to 32 neighbours have places; a key is a neighbour's square but for the lowest bits, which are its place. Keys
 * ascend, but that the last of k is the farthest's by the real numbers. Unlike those of a heap of items, moves of keys
 * need no branches, and compare two at once. */
#define FEW_BITS 5
#define FEW_NEIGHBORS (1 << FEW_BITS)
#define FEW_FIRST 3 /* before the first key there are less ones, for pairs to end in */
typedef struct few_neighbors {
    double keys[FEW_FIRST + FEW_NEIGHBORS];
    double squares[FEW_NEIGHBORS]; /* by place */
    const octree_point *points[FEW_NEIGHBORS];
} few_neighbors;

typedef struct neighbor_heap {
    metric metric;
    octree_search how;
    double radius; /* negative: there is none */
    double radius_square;
    double shrink;          /* 1 / (1 + epsilon)^2, rounded up: a node farther than the farthest by this is left out */
    double point_reach;     /* a point whose square is beyond this is not among the k nearest */
    double node_reach;      /* and so is no point of a node whose square is beyond this */
    octree_neighbor *items; /* `distance` holds scaled squares until the end */
    size_t count, k;
    few_neighbors few; /* in place of items until the end */
} neighbor_heap;

/* `h` has its metric. */
void neighbor_heap_begin(neighbor_heap *h, const octree_search *how, double radius, octree_neighbor *room, size_t k);

/* Points beyond this square are not among the k nearest, given that some point of the tree has the square `square`. */
static inline double neighbor_heap_reach(const neighbor_heap *h, double square)
{
    const double reach = metric_above(square);
    return h->k == 1 && h->how.skip == OCTREE_SKIP_NONE && reach < h->point_reach ? reach : h->point_reach;
}

/* Add a point whose square is not beyond point_reach, if it counts and is among the k nearest so far. */
void neighbor_heap_add(neighbor_heap *h, const octree_point *point, double square);

/* Sort by distance, then by id, then by position; squares become distances. */
void neighbor_heap_finish(neighbor_heap *h);

#endif
