/* batch.h - the points of a change to many, in Morton order. Private. */
#ifndef OCTREE_BATCH_H
#define OCTREE_BATCH_H

#include "tree.h"

#define BATCH_STORED UINT32_MAX

typedef struct batch_item {
    uint64_t code;
    const octree_point *point;
    uint32_t place; /* in the caller's array; BATCH_STORED for a point that was in the tree before */
} batch_item;

typedef struct batch {
    octree *tree;
    const octree_point *points;
    octree_status *statuses; /* the caller's, or of its own: one a point */
    bool owns_statuses;
    size_t point_count;
    batch_item *items; /* those that lie in the world, by code, then by place */
    size_t count, room;
} batch;

/* OK, NO_MEMORY or TOO_MANY. Statuses are OK, or say why a point is not among the items. */
octree_status batch_begin(batch *b, octree *tree, const octree_point *points, size_t count, octree_status *statuses);
void batch_end(batch *b);

static inline void batch_set(const batch *b, const batch_item *item, octree_status status)
{
    if (item->place != BATCH_STORED)
        b->statuses[item->place] = status;
}

/* The number of points whose status is OK. */
size_t batch_done(const batch *b);

/* How many of the sorted items lie in an octant of a cell of this depth that begins with the first of them. */
size_t batch_share(const batch_item *items, size_t count, unsigned depth);

#endif
