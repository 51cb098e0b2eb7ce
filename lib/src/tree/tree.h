/* SPDX-License-Identifier: MIT */
/* tree.h - the tree itself: its making, its definition, and the path from its root to a leaf.
 *
 * Canonical form: a node is an inner node exactly when it holds more points than the capacity and its cell can be
 * divided further. So the nodes follow from the contents, whatever the order of changes.
 */
#ifndef OCTREE_TREE_H
#define OCTREE_TREE_H

#include "change_log.h"
#include "leaf.h"
#include "plane.h"

/* How the capacity is chosen under OCTREE_AUTO. A function pointer, so that insertion does not depend on tune.c. */
typedef struct tuning {
    octree_status (*choose)(octree *tree, const octree_mix *mix); /* null: the capacity is fixed */
    octree_mix mix;
    size_t due; /* the number of points at which it is chosen next */
} tuning;

struct octree {
    octree_def def; /* as in force */
    axis axes[3];
    double scale; /* the power of two that brings the world's extent near 1 (metric.h) */
    uint64_t version;
    change_log changes;
    tuning tuning;
    node root;
    store store;
};

/* Whether all coordinates are subnormal, and their differences. */
static inline bool is_subnormal_world(const octree *tree)
{
    return tree->axes[0].subnormal && tree->axes[1].subnormal && tree->axes[2].subnormal;
}

/* True when a full leaf in this cell splits rather than refuses or grows. */
static inline bool may_split(const octree *tree, cell c)
{
    return c.depth < tree->def.max_depth && cell_divisible(tree->axes, c);
}

/* Nodes that hold no more points than this merge, and those that hold more split where they may. */
static inline bool fits_leaf(const octree *tree, size_t count)
{
    return count <= tree->def.leaf_capacity;
}

/* OK, NULL_ARGUMENT, FLOAT_MODE, NOT_FINITE or OUTSIDE. */
octree_status check_position(const octree *tree, const double position[3]);

/* DUPLICATE, FULL, NO_MEMORY, TOO_MANY or OK, for a position that was checked, and its code. Unless it `divides`, a
 * leaf that holds as many points as the capacity is FULL: then removing the point again takes no memory. */
octree_status insert_point(octree *tree, const octree_point *point, uint64_t code, bool divides);

/* Remove an empty leaf from its parent's group of children; the end of the group's block is freed. */
void drop_child(octree *tree, node *parent, node *child);

/* After points were inserted: choose the capacity if it is due. Without memory it stays as it is. */
void tune_if_due(octree *tree);

/* The same points in a tree of another definition. Errors: those of octree_create, OUTSIDE, FULL, NO_MEMORY; the tree
 * is then unchanged. */
octree_status rebuild(octree *tree, const octree_def *def);

/* The nodes from the root towards a code, as deep as they exist. The last one is a leaf, or an inner node whose octant
 * for this code is not occupied. */
typedef struct path {
    node *nodes[OCTREE_MAX_DEPTH + 1];
    unsigned depth; /* of the last node */
} path;

path path_to(const octree *tree, uint64_t code);

static inline node *path_end(const path *p)
{
    return p->nodes[p->depth];
}

/* Where a pair (position, id) is stored. */
typedef struct found_point {
    path path;
    uint32_t index; /* in the leaf at the path's end */
} found_point;

/* False when the pair is not in the tree. */
bool find_point(const octree *tree, const double position[3], uint64_t id, found_point *found);

#endif
