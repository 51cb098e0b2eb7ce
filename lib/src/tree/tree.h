/* SPDX-License-Identifier: MIT */
/* tree.h - the tree, its canonical form, and the path from the root to a leaf.
 *
 * Canonical form: a node is an inner node if and only if it holds more points than the capacity and its cell is
 * divisible. So the nodes depend on the contents only, not on the order of changes.
 */
#ifndef OCTREE_TREE_H
#define OCTREE_TREE_H

#include "change_log.h"
#include "leaf.h"
#include "plane.h"
#include "visits.h"

/* How the capacity is chosen under OCTREE_AUTO. Insertion calls this function pointer and not octree_tune(), so that a
 * program without OCTREE_AUTO does not link tune.c. */
typedef struct tuning {
    octree_status (*choose)(octree *tree, const octree_mix *mix); /* null: the capacity is fixed */
    octree_mix mix;
    size_t due; /* the number of points at which the capacity is chosen next */
} tuning;

struct octree {
    octree_def def; /* the caller's definition after clamping, with the capacity in force */
    axis axes[3];
    double scale; /* the power of two that brings the world's extent near 1 (metric.h) */
    uint64_t version;
    change_log changes;
    tuning tuning;
    node root;
    store store;
};

/* Whether all coordinates and their differences are subnormal. */
static inline bool is_subnormal_world(const octree *tree)
{
    return tree->axes[0].subnormal && tree->axes[1].subnormal && tree->axes[2].subnormal;
}

/* Whether a full leaf in this cell splits, rather than refuses or grows. */
static inline bool can_split(const octree *tree, cell c)
{
    return c.depth < tree->def.max_depth && cell_divisible(tree->axes, c);
}

/* Whether this many points fit one leaf. If so, nodes merge; if not, they split wherever their cell is divisible. */
static inline bool fits_leaf(const octree *tree, size_t count)
{
    return count <= tree->def.leaf_capacity;
}

/* Check whether a position is in the world. Returns OK, NULL_ARGUMENT, NOT_FINITE or OUTSIDE. */
octree_status check_position(const octree *tree, const double position[3]);

/* Check the position for a change of the tree. Returns the statuses of check_position(), or BUSY inside a callback of
 * the tree. */
static inline octree_status check_change(const octree *tree, const double position[3])
{
    const octree_status status = check_position(tree, position);
    return status == OCTREE_OK && is_visited(tree) ? OCTREE_BUSY : status;
}

/* Insert a point with a valid position and its Morton code. Returns OK, DUPLICATE, FULL, NO_MEMORY or TOO_MANY. If
 * `divides` is false, a leaf at its capacity returns FULL even if it could split; removing the point again then needs
 * no memory. */
octree_status insert_point(octree *tree, const octree_point *point, uint64_t code, bool divides);

/* Remove a point whose position is in the world. *point receives the stored position, in which zeros may have other
 * signs. Returns OK, NOT_FOUND or NO_MEMORY. */
octree_status remove_point(octree *tree, octree_point *point);

/* Remove an empty leaf from its parent's group of children. The unused end of the group's block is freed. */
void remove_empty_child(octree *tree, node *parent, node *child);

/* After an insertion, choose the capacity again if the tree has reached the number of points for it. Without memory the
 * capacity stays the same. */
void tune_if_due(octree *tree);

/* Rebuild the tree with another definition. Errors: those of octree_create, OUTSIDE, FULL, NO_MEMORY; the tree is then
 * unchanged. */
octree_status rebuild_tree(octree *tree, const octree_def *def);

/* The existing nodes on the way from the root to the cell of a code. The last node is a leaf, or an inner node that has
 * no child in the code's octant. */
typedef struct path {
    node *nodes[OCTREE_MAX_DEPTH + 1];
    unsigned depth; /* the depth of the last node */
} path;

path find_path(const octree *tree, uint64_t code);

static inline node *path_end(const path *p)
{
    return p->nodes[p->depth];
}

/* The place at which a pair (position, id) is stored. */
typedef struct found_point {
    path path;
    uint32_t index; /* the point's index in the leaf at the path's end */
} found_point;

static inline octree_point stored_point(const found_point *found)
{
    return leaf_points(path_end(&found->path))[found->index];
}

/* Find a pair (position, id). False when it is not in the tree. */
bool find_point(const octree *tree, const double position[3], uint64_t id, found_point *found);

#endif
