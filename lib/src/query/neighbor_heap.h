/* SPDX-License-Identifier: MIT */
/* neighbor_heap.h - the k nearest neighbours found so far, decided by the real numbers. Private.
 *
 * A heap in the caller's array, the farthest on top. Squared distances in doubles decide whenever their proven error
 * allows (metric.h), exact arithmetic decides the rest: so rounding never picks a neighbour.
 */
#ifndef OCTREE_NEIGHBOR_HEAP_H
#define OCTREE_NEIGHBOR_HEAP_H

#include "metric.h"

#include <stddef.h>

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
} neighbor_heap;

neighbor_heap neighbor_heap_make(const metric *m, const octree_search *how, double radius, octree_neighbor *room,
                                 size_t k);

/* Points beyond this square are not among the k nearest, given that some point of the tree has the square `square`. */
static inline double neighbor_heap_reach(const neighbor_heap *h, double square)
{
    const double reach = metric_above(square);
    return h->k == 1 && h->how.skip == OCTREE_SKIP_NONE && reach < h->point_reach ? reach : h->point_reach;
}

/* Add a point whose square is not beyond point_reach, if it counts and is among the k nearest so far. */
void neighbor_heap_add(neighbor_heap *h, const octree_point *point, double square);

/* Sort by distance, then by id, then by position; squares become distances. */
void neighbor_heap_finish(const neighbor_heap *h);

#endif
