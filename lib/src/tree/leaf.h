/* leaf.h - the points of one leaf.
 *
 * Up to 64 points lie in a block of the tree's pool. A leaf beyond that, a crowd, has a block of its own with a hash
 * table behind the points, so that a million equal points are inserted and removed in constant time each.
 */
#ifndef OCTREE_LEAF_H
#define OCTREE_LEAF_H

#include "hashed_leaf.h"
#include "tree.h"

#define LEAF_CROWD 255
#define LEAF_NONE UINT32_MAX

static inline octree_point *leaf_points(const node *leaf)
{
    return leaf->below;
}

/* Ask for the memory of all points of a leaf, of a crowd the first. The processor's own guess comes some lines late,
 * which is a quarter of the time of a query whose leaves are not in its cache. */
static inline void leaf_prefetch(const node *leaf)
{
    for (uint32_t i = 0; i < leaf->count && i < POOL_MAX_UNITS; i += 2)
        prefetch(&leaf_points(leaf)[i]);
}

/* The index of the pair (position, id), or LEAF_NONE. */
uint32_t leaf_find(const node *leaf, const double position[3], uint64_t id);

/* A leaf of no points with room for `count` of them. False when there is no memory. */
bool leaf_create(octree *tree, node *leaf, uint32_t count);

/* Append a pair that is not there yet. False when there is no memory; nothing has changed then. */
bool leaf_append(octree *tree, node *leaf, const octree_point *point);

/* Append a pair that is not there yet to a leaf that has room for it. */
static inline void leaf_put(node *leaf, const octree_point *point)
{
    if (leaf->room == LEAF_CROWD)
        crowd_append(leaf->below, leaf->count, point);
    else
        leaf_points(leaf)[leaf->count] = *point;
    leaf->count++;
}

/* Take the point at an index out; the last one takes its place. Cannot fail. */
void leaf_take(octree *tree, node *leaf, uint32_t index);

/* Overwrite the point at an index with a pair that is not there yet. Cannot fail. */
void leaf_replace(node *leaf, uint32_t index, const octree_point *point);

/* Append all points in and below `from` to a leaf with room for them, but for the one to be left out (or null). */
void leaf_gather(node *leaf, const node *from, const octree_point *left_out);

void leaf_release(octree *tree, node *leaf);

#endif
