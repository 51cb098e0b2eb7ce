/* batch.h - the points of a change to many, in Morton order. Private. */
#ifndef OCTREE_BATCH_H
#define OCTREE_BATCH_H

#include "morton_sort.h"
#include "tree.h"

typedef struct batch {
    octree *tree;
    const octree_point *points;
    const octree_point *stored; /* of the leaf whose points are among the items, when there is one */
    octree_status *statuses;    /* the caller's, one a point; may be null */
    size_t point_count;
    morton_item *items; /* those that lie in the world, by code; loose where a new tree will have leaves */
    size_t count, room;
    bool repeated; /* some items may have one code */
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
    if (!item->stored && b->statuses)
        b->statuses[item->place] = status;
}

/* How many items of a cell may be left loose where nothing is stored yet: they become a leaf. */
static inline size_t batch_loose(const octree *tree)
{
    return tree->def.leaf_capacity < MORTON_LOOSE ? tree->def.leaf_capacity : MORTON_LOOSE;
}

/* How many of the sorted items lie in an octant of a cell of this depth that begins with the first of them. */
size_t batch_share(const morton_item *items, size_t count, unsigned depth);

#endif
