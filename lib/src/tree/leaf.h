/* SPDX-License-Identifier: MIT */
/* leaf.h - the nodes of a tree and the points of its leaves.
 *
 * A leaf of up to 64 points is a block of the tree's pool. A larger leaf is hashed: a separate allocation with a hash
 * table, so that each of a million equal points is inserted and removed in constant time.
 */
#ifndef OCTREE_LEAF_H
#define OCTREE_LEAF_H

#include "../exact/bits.h"
#include "../exact/point.h"
#include "pool.h"

typedef struct node {
    /* an inner node: its children, struct node[], in the order of their octants; a leaf: its points, octree_point[], or
     * null */
    void *below;
    uint32_t count;  /* the number of points in and below the node */
    uint8_t octants; /* bit i is set if the node has a child in octant i; 0 for a leaf */
    uint8_t room;    /* only in a leaf: the capacity of the leaf's block in points, or LEAF_HASHED */
} node;

#define LEAF_HASHED 255
#define LEAF_NONE UINT32_MAX

/* The allocators of a tree's memory: an arena, and the two pools that get their memory from the arena. */
typedef struct store {
    arena memory;
    pool nodes; /* allocates the groups of sibling nodes */
    pool points;
} store;

/* Initialize the pools of a store. The caller has already set the member `memory`. `node_size` is sizeof(node), or
 * NODE_WITH_BOX. */
void store_init(store *s, size_t node_size);

/* Tell empty pools how many points will be stored, so that their first slabs are large enough. One large slab is
 * allocated faster than many small slabs, and malloc keeps a large slab's memory for the next build instead of
 * returning it to the system. With a count of 0, the pools grow as usual. */
void store_expect_points(store *s, size_t count);

/* Free the nodes below a root, and all blocks of the pools. */
void store_release(store *s, const node *root);

/* A group of siblings is a block of the pool `nodes`: the array of the nodes, and in trees of bodies a box for each
 * node. The tree only marks the boxes of new nodes as unknown; bodies/boxes.c computes them.
 *
 * An unknown box is infinite. */
enum { NODE_WITH_BOX = sizeof(node) + sizeof(octree_box) };

static inline bool has_boxes(const store *s)
{
    return s->nodes.unit == NODE_WITH_BOX;
}

/* Returns the boxes of a group whose nodes have boxes. */
static inline octree_box *boxes_of_group(const node *group, unsigned siblings)
{
    return (octree_box *)(uintptr_t)(group + siblings);
}

/* Allocate a group for `siblings` nodes. Returns null if memory runs out. The nodes are not initialized. */
node *group_allocate(store *s, unsigned siblings);
void group_free(store *s, node *group, unsigned siblings);

/* Make a copy of a group with a gap for another node at an index. Returns null if memory runs out. */
node *group_copy_with_gap(store *s, const node *group, unsigned siblings, unsigned index);

/* Remove the node at an index from a group. */
void group_remove(store *s, node *group, unsigned siblings, unsigned index);

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

/* Returns the child in an octant that has a child. Only queries call this function: see bits_look_up_count8(). */
static inline node *look_up_child(const node *n, unsigned octant)
{
    return children_of(n) + bits_look_up_count8(n->octants & ((1u << octant) - 1));
}

/* Returns the child in an octant. Returns null if there is no child in this octant. */
static inline node *child_at(const node *n, unsigned octant)
{
    return n->octants >> octant & 1 ? children_of(n) + child_index(n, octant) : NULL;
}

/* Start to load memory into the caches, because it will be read soon. This affects only the speed. The empty assembly
 * statement counts as a side effect. Without the statement, GCC treats a function that only prefetches as free of side
 * effects, and drops the calls of such a function. */
static inline void prefetch_memory(const void *memory)
{
#if defined(__GNUC__)
    __builtin_prefetch(memory);
    __asm__ volatile("");
#else
    (void)memory;
#endif
}

/* Prefetch the points of a leaf; of a hashed leaf only the first points. Without this function, the processor's own
 * prefetcher starts some cache lines late. This costs a quarter of a query's time if leaves are not cached. The loop
 * prefetches blocks of eight points, so that its branches are predictable; prefetching past the last point does no
 * harm. */
static inline void leaf_prefetch(const node *leaf)
{
    enum { TOGETHER = 8, A_LINE = 2 };
    const uintptr_t points = (uintptr_t)leaf->below;
    for (uint32_t i = 0; i < leaf->count && i < POOL_MAX_UNITS; i += TOGETHER)
        for (uint32_t k = i; k < i + TOGETHER; k += A_LINE)
            prefetch_memory((const void *)(points + k * sizeof(octree_point)));
}

/* Prefetch the children of an inner node or the points of a leaf. */
static inline void prefetch_node(const node *n)
{
    if (n->octants)
        prefetch_memory(n->below);
    else
        leaf_prefetch(n);
}

/* Returns the index of the pair (position, id) in a leaf, or LEAF_NONE if the leaf does not have the pair. */
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
        if (points[i].id == id && is_same_position(points[i].position, position))
            return i;
    return LEAF_NONE;
}

/* Returns the capacity, in points, of the block that is allocated for `count` points. `count` is at most
 * POOL_MAX_UNITS. */
unsigned leaf_block_room(uint32_t count);

/* Make an empty leaf with room for `count` points. Returns false if memory runs out. */
bool leaf_create(store *s, node *leaf, uint32_t count);
void leaf_release(store *s, const node *leaf);

/* Append a point that the leaf does not hold yet. Returns false and leaves the leaf unchanged if memory runs out. */
bool leaf_append(store *s, node *leaf, const octree_point *point);

/* leaf_is_full() returns whether the leaf's block has no room for another point. leaf_copy_larger() makes a copy of the
 * leaf with room for at least one more point, and returns false if memory runs out. */
bool leaf_is_full(const node *leaf);
bool leaf_copy_larger(store *s, const node *leaf, node *copy);

/* Append a point to a leaf that has room. The leaf must not hold the point yet. Cannot fail. */
void leaf_append_hashed(node *leaf, const octree_point *point);
static inline void leaf_append_unchecked(node *leaf, const octree_point *point)
{
    if (leaf->room == LEAF_HASHED)
        leaf_append_hashed(leaf, point);
    else
        leaf_points(leaf)[leaf->count++] = *point;
}

/* Remove the point at an index. The leaf's last point moves to this index. Cannot fail. */
void leaf_remove(store *s, node *leaf, uint32_t index);

/* leaf_remove_keeping_block() removes a point as leaf_remove() does, but does not free the unused end of the leaf's
 * block. leaf_free_end() frees this end later; `old` is a copy of the leaf from before the removal. A hashed leaf keeps
 * its whole block. */
void leaf_remove_keeping_block(node *leaf, uint32_t index);
void leaf_free_end(store *s, const node *old);

/* If a hashed leaf uses little of its block, move its points to a smaller block. If memory runs out, the leaf keeps its
 * block. */
void leaf_shrink_hash_table(store *s, node *leaf);

/* Replace the point at an index. The leaf must not hold the new point yet. Cannot fail. */
void leaf_replace(node *leaf, uint32_t index, const octree_point *point);

/* Append all points in and below the node `from` to a leaf that has room for these points. The point `except` is left
 * out; `except` may be null. */
void leaf_append_all(node *leaf, const node *from, const octree_point *except);

/* Copy the points in and below a node to an array, in the order of their leaves. Returns the address after the last
 * copy. */
octree_point *node_copy_points(const node *n, octree_point *to);

/* Free the children or points of a node, and everything below the node. The node itself belongs to the caller. */
void node_release(store *s, const node *n);

/* Free everything below a node, except the blocks that `other` uses too. `other` is another version of the node. */
void node_release_unshared(store *s, const node *n, const node *other);

#endif
