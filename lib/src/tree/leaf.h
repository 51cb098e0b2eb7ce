/* SPDX-License-Identifier: MIT */
/* leaf.h - the nodes of a tree, and the points of those that are leaves.
 *
 * Up to 64 points lie in a block of the tree's pool. A larger leaf is hashed: it has a block of its own with a hash
 * table, so that a million equal points are inserted and removed in constant time each.
 */
#ifndef OCTREE_LEAF_H
#define OCTREE_LEAF_H

#include "bits.h"
#include "point.h"
#include "pool.h"

typedef struct node {
    void *below;     /* inner: struct node[], the occupied octants' children; leaf: octree_point[]; may be null */
    uint32_t count;  /* points in and below */
    uint8_t octants; /* bit mask of the occupied ones; 0 for a leaf */
    uint8_t room;    /* leaf: points that its block has room for, or LEAF_HASHED */
} node;

#define LEAF_HASHED 255
#define LEAF_NONE UINT32_MAX

/* A stack of nodes still to be visited never holds more: 7 siblings for each level, and 8 at the deepest. */
#define STACK_ROOM (7 * OCTREE_MAX_DEPTH + 8)

/* The memory of a tree. */
typedef struct store {
    arena memory;
    pool nodes; /* groups of siblings */
    pool points;
} store;

static inline node *children_of(const node *n)
{
    return n->below;
}

static inline octree_point *leaf_points(const node *leaf)
{
    return leaf->below;
}

static inline unsigned child_index(const node *n, unsigned octant)
{
    return bits_count8(n->octants & ((1u << octant) - 1));
}

/* The child in an octant, or null when the octant is not occupied. */
static inline node *child_at(const node *n, unsigned octant)
{
    return n->octants >> octant & 1 ? children_of(n) + child_index(n, octant) : NULL;
}

/* Start loading memory that will be read soon. Only speed depends on it. (GCC takes a function that does nothing else
 * for one without effect and leaves calls of it out: an empty statement of assembly is an effect.) */
static inline void prefetch(const void *memory)
{
#if defined(__GNUC__)
    __builtin_prefetch(memory);
    __asm__ volatile("");
#else
    (void)memory;
#endif
}

/* All points of a leaf; of a hashed one the first. The processor's own prefetching comes some cache lines late, a
 * quarter of the time of a query whose leaves are not in the cache. Eight points at a time, for where they end cannot
 * be foreseen; what lies behind them does no harm. */
static inline void leaf_prefetch(const node *leaf)
{
    enum { TOGETHER = 8, A_LINE = 2 };
    const uintptr_t points = (uintptr_t)leaf->below;
    for (uint32_t i = 0; i < leaf->count && i < POOL_MAX_UNITS; i += TOGETHER)
        for (uint32_t k = i; k < i + TOGETHER; k += A_LINE)
            prefetch((const void *)(points + k * sizeof(octree_point)));
}

/* The index of the pair (position, id), or LEAF_NONE. */
uint32_t leaf_find_hashed(const node *leaf, const double position[3], uint64_t id);
static inline uint32_t leaf_find(const node *leaf, const double position[3], uint64_t id)
{
    const octree_point *points = leaf_points(leaf);
    if (leaf->room == LEAF_HASHED)
        return leaf_find_hashed(leaf, position, id);
    uint32_t i = 0;
    while (i + 4 <= leaf->count && points[i].id != id && points[i + 1].id != id && points[i + 2].id != id &&
           points[i + 3].id != id)
        i += 4;
    for (; i < leaf->count; i++)
        if (points[i].id == id && same_position(points[i].position, position))
            return i;
    return LEAF_NONE;
}

/* The room that a block has which holds so many points, at most POOL_MAX_UNITS. */
unsigned leaf_room(uint32_t count);

/* An empty leaf with room for `count` points. False when there is no memory. */
bool leaf_create(store *s, node *leaf, uint32_t count);
void leaf_release(store *s, const node *leaf);

/* Append a pair that is not there yet. False when there is no memory; nothing has changed then. */
bool leaf_append(store *s, node *leaf, const octree_point *point);

/* The same for a leaf that has room for it. */
void leaf_put_hashed(node *leaf, const octree_point *point);
static inline void leaf_put(node *leaf, const octree_point *point)
{
    if (leaf->room == LEAF_HASHED)
        leaf_put_hashed(leaf, point);
    else
        leaf_points(leaf)[leaf->count++] = *point;
}

/* Remove the point at an index; the last point moves into its place. Cannot fail. */
void leaf_remove(store *s, node *leaf, uint32_t index);

/* Overwrite the point at an index with a pair that is not there yet. Cannot fail. */
void leaf_replace(node *leaf, uint32_t index, const octree_point *point);

/* Append all points in and below a node, except for one (may be null), to a leaf that has room for them. */
void node_gather(node *leaf, const node *from, const octree_point *except);

/* Copy the points in and below a node, in the order of their leaves. Returns the end of the copies. */
octree_point *node_copy_points(const node *n, octree_point *to);

/* Free the children or points of a node, and all below it; the node itself is the caller's. */
void node_release(store *s, const node *n);

/* The same, but for what it shares with another version of the node in the same cell: what has the same block. */
void node_release_unshared(store *s, const node *n, const node *other);

#endif
