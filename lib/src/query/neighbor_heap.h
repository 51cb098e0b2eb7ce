/* best.h - the k best neighbours found so far, decided by the real numbers. Private.
 *
 * A heap in the caller's array, the worst on top; of few, in descending order. Squared distances in doubles decide
 * whenever their proven error allows (metric.h), exact arithmetic decides the rest: so rounding never picks a
 * neighbour.
 */
#ifndef OCTREE_BEST_H
#define OCTREE_BEST_H

#include "metric.h"

#include <stddef.h>

typedef struct best {
    metric metric;
    octree_search how;
    double radius; /* negative: there is none */
    double radius_square;
    double shrink;         /* 1 / (1 + epsilon)^2, rounded up: a node farther than this part of the worst is left out */
    double point_reach;    /* a point whose square is beyond this is not among the best */
    double node_reach;     /* and so is no point of a node whose square is beyond this */
    octree_neighbor *heap; /* `distance` holds scaled squares until the end */
    size_t count, k;
} best;

best best_make(const metric *m, const octree_search *how, double radius, octree_neighbor *room, size_t k);

/* Of points among which one has this square, none beyond this is among the best, whether or not that one is taken. */
static inline double best_reach_beside(const best *b, double square)
{
    const double reach = metric_above(square);
    return b->k == 1 && b->how.skip == OCTREE_SKIP_NONE && reach < b->point_reach ? reach : b->point_reach;
}

/* Take in a point whose square is not beyond point_reach, if it counts and is better than the worst. */
void best_consider(best *b, const octree_point *point, double square);

/* Sort by distance, then by id, then by position; squares become distances. */
void best_finish(const best *b);

#endif
