/* batch.h - the points of a change to many, in Morton order. Private. */
#ifndef OCTREE_BATCH_H
#define OCTREE_BATCH_H

#include "morton_sort.h"
#include "tree.h"

typedef struct batch {
    octree *tree;
    const octree_point *points;
    const octree_point *stored; /* of the leaf whose points are among the items, when there is one */
    octree_status *statuses;    /* the caller's, or of its own: one a point */
    bool owns_statuses;
    size_t point_count;
    morton_item *items; /* those that lie in the world, by code, then by place */
    size_t count, room;
} batch;

/* OK, NO_MEMORY or TOO_MANY. Statuses are OK, or say why a point is not among the items. */
octree_status batch_begin(batch *b, octree *tree, const octree_point *points, size_t count, octree_status *statuses);
void batch_end(batch *b);

static inline const octree_point *batch_point(const batch *b, const morton_item *item)
{
    return (item->stored ? b->stored : b->points) + item->place;
}

static inline void batch_set(const batch *b, const morton_item *item, octree_status status)
{
    if (!item->stored)
        b->statuses[item->place] = status;
}

/* The number of points whose status is OK. */
size_t batch_done(const batch *b);

/* How many of the sorted items lie in an octant of a cell of this depth that begins with the first of them. */
size_t batch_share(const morton_item *items, size_t count, unsigned depth);

#endif
