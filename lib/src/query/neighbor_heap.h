/* SPDX-License-Identifier: MIT */
/* neighbor_heap.h - the k nearest neighbours found so far, compared exactly. Private.
 *
 * Up to 32 neighbours are kept in order, more in a heap. Squared distances in doubles decide when their proven error
 * allows it (metric.h); otherwise exact arithmetic decides. So rounding never selects a neighbour.
 */
#ifndef OCTREE_NEIGHBOR_HEAP_H
#define OCTREE_NEIGHBOR_HEAP_H

#include "../exact/metric.h"

#include <stddef.h>

/* Up to 32 neighbours in numbered slots. A "square" is a scaled squared distance from the target. The key of a
 * neighbour is its square, with the lowest FEW_BITS bits replaced by the number of its slot. The keys ascend.
 *
 * Beyond k neighbours, all points are kept whose keys are too close to that of the k-th to decide, and the end of the
 * search selects among them. If there are too many of them, the neighbours are crowded: from then on exactly k are
 * kept, in the exact order. */
#define FEW_NEIGHBORS 32
#define FEW_BITS 6
#define FEW_SLOTS (1 << FEW_BITS)
/* The index of the first key. The elements before it are smaller sentinels, so that insertion in pairs may run past the
 * start. */
#define FEW_FIRST 5
typedef struct few_neighbors {
    double keys[FEW_FIRST + FEW_SLOTS];
    double squares[FEW_SLOTS]; /* the square of each neighbour, indexed by slot like `points` */
    const octree_point *points[FEW_SLOTS];
    uint64_t free_slots; /* bit i is set if slot i is free; valid once k neighbours are found */
    bool is_crowded;
    /* The squares of neighbours in near ties, as integers. Bit i of `integers_known` is set if the integer of slot i
     * has been computed. `unit` is valid if at least one has. */
    uint64_t integers_known;
    metric_integer integers[FEW_SLOTS];
    metric_unit unit;
} few_neighbors;

typedef struct neighbor_heap {
    metric metric;
    const octree_search *how;
    bool is_filtered; /* true: some points are skipped, or the distance is limited */
    double radius;    /* the search radius; negative: the distance is not limited */
    double radius_square;
    /* 1 / (1 + epsilon)^2, rounded up: a node is pruned if its squared distance exceeds the squared distance of the
     * farthest of k neighbours times this factor */
    double shrink;
    double worst; /* the squared distance of the farthest of k neighbours; not valid before k neighbours are found */
    double point_reach; /* a point with a greater scaled squared distance is not among the k nearest */
    double node_error;  /* the greatest error of the distances of nodes */
    double node_reach;  /* a node with a greater scaled squared distance contains none of the k nearest */
    /* the caller's array of neighbours. Until the end of the search, `distance` holds the scaled squared distance */
    octree_neighbor *items;
    size_t count, k;
    few_neighbors few; /* if k <= FEW_NEIGHBORS, holds the neighbours in place of `items` until the end of the search */
} neighbor_heap;

/* Limit the distance of neighbours to `radius`. neighbor_heap_begin() calls this function. */
void neighbor_heap_set_radius(neighbor_heap *h, double radius);

/* Start a search for the k nearest neighbours. The caller has set h->metric and h->node_error. If `radius` is negative,
 * the distance is not limited. `room` is the caller's array of k neighbours. */
static inline void neighbor_heap_begin(neighbor_heap *h, const octree_search *how, double radius, octree_neighbor *room,
                                       size_t k)
{
    h->how = how;
    h->is_filtered = how->skip != OCTREE_SKIP_NONE;
    h->radius = -1;
    h->shrink = how->epsilon > 0 ? (1 + 0x1p-50) / ((1 + how->epsilon) * (1 + how->epsilon)) : 1;
    h->point_reach = h->node_reach = INFINITY;
    h->items = room;
    h->count = 0;
    h->k = k;
    h->few.integers_known = 0;
    h->few.is_crowded = false;
    if (radius >= 0)
        neighbor_heap_set_radius(h, radius);
    for (int i = 0; k > 1 && i < FEW_FIRST; i++)
        h->few.keys[i] = -1;
}

/* Divide the squares into NEIGHBOR_GROUPS groups. Returns the greatest of the groups' minima: at least NEIGHBOR_GROUPS
 * squares, one of each group, do not exceed this value. No square is NaN, because points of the world are finite. */
#define NEIGHBOR_GROUPS 8
double greatest_group_minimum(const double squares[], unsigned count);

/* Returns a limit: a point with a greater squared distance is not among the k nearest. `squares` are the squared
 * distances of the `count` points that will be offered next, and `least` is the least of these squares. Before the
 * first neighbour is found, an upper bound of the k-th least of these squares is such a limit. */
static inline double neighbor_heap_reach(const neighbor_heap *h, const double squares[], unsigned count, double least)
{
    double reach = h->point_reach;
    if (h->how->skip == OCTREE_SKIP_NONE && h->k == 1)
        reach = metric_above(least);
    else if (h->how->skip == OCTREE_SKIP_NONE && h->count == 0 && h->k <= NEIGHBOR_GROUPS && count >= NEIGHBOR_GROUPS)
        reach = metric_above(greatest_group_minimum(squares, count));
    return reach < h->point_reach ? reach : h->point_reach;
}

/* Offer the points whose bit is set in the mask `within`; there are at most 64 points. A point is kept if it is among
 * the k nearest so far and not skipped. */
void neighbor_heap_add(neighbor_heap *h, const octree_point *points, const double squares[], uint64_t within);

/* Returns whether the square root of a squared distance is accurate, because the squared distance is far from overflow
 * and underflow. The squared distance must not be scaled. */
static inline bool is_root_accurate(double square)
{
    return 0x1p-900 < square && square < 0x1p900;
}

/* Returns the square root of a positive number. sqrt() would also check for a negative number, to set errno. */
static inline double positive_root(double square)
{
#ifdef OCTREE_SSE2
    const __m128d both = _mm_set_sd(square);
    return _mm_cvtsd_f64(_mm_sqrt_sd(both, both));
#else
    return sqrt(square);
#endif
}

/* Returns the distance of a neighbour whose scaled squared distance is `square`. */
static inline double neighbor_distance(const neighbor_heap *h, const octree_point *point, double square)
{
    return h->metric.scale == 1 && is_root_accurate(square) ? positive_root(square)
                                                            : metric_distance(h->metric.target, point->position);
}

/* Sort the neighbours by distance, id and position. Replace their squares by distances. */
void neighbor_heap_sort(neighbor_heap *h);

/* Store the results in the caller's array, sorted and with distances. A single neighbour needs no sorting. */
static inline void neighbor_heap_finish(neighbor_heap *h)
{
    if (h->k > 1) {
        neighbor_heap_sort(h);
    } else if (h->count > 0) {
        h->items[0].point = *h->few.points[0];
        h->items[0].distance = neighbor_distance(h, h->few.points[0], h->few.squares[0]);
    }
}

#endif
