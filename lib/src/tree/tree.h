/* SPDX-License-Identifier: MIT */
/* tree.h - the tree, its canonical form, and the path from the root to a leaf.
 *
 * Canonical form: a node is an inner node if and only if it holds more points than the capacity and its cell is
 * divisible. So the contents of a tree determine its nodes; the order of changes does not matter.
 */
#ifndef OCTREE_TREE_H
#define OCTREE_TREE_H

#include "change_log.h"
#include "leaf.h"
#include "plane.h"
#include "visits.h"

/* How the capacity is chosen under OCTREE_AUTO. Insertion calls octree_tune() through the pointer `choose`, so that a
 * program without OCTREE_AUTO does not link tune.c. */
typedef struct tuning {
    /* the function that chooses the capacity; null: the capacity is fixed */
    octree_status (*choose)(octree *tree, const octree_mix *mix);
    octree_mix mix;
    size_t due; /* the number of points at which the capacity will be chosen again */
} tuning;

struct octree {
    octree_def def; /* the caller's definition with clamped values, and with the capacity in force */
    axis axes[3];
    /* a power of two by which coordinates are multiplied, so that the world's extent is moderate (metric.h) */
    double scale;
    double key_squares[3]; /* on each axis, the square of the distance between adjacent grid planes */
    /* the greatest error of a distance from a point to a plane, if the distance is computed from keys */
    double key_error;
    /* true: key_squares and key_error are valid. false: the scale is not 1, or on some axis no guessed key is certain
     * (plane.h) */
    bool has_key_squares;
    uint64_t version;
    change_log changes;
    tuning tuning;
    node root;
    store store;
};

/* Returns whether all coordinates of the world and their differences are subnormal. */
static inline bool is_subnormal_world(const octree *tree)
{
    return tree->axes[0].subnormal && tree->axes[1].subnormal && tree->axes[2].subnormal;
}

/* Returns whether a full leaf in this cell splits. If not, the leaf refuses a new point or grows. */
static inline bool can_split(const octree *tree, cell c)
{
    return c.depth < tree->def.max_depth && is_cell_divisible(tree->axes, c);
}

/* Returns whether this many points fit into one leaf. If so, nodes merge; if not, nodes split wherever their cell is
 * divisible. */
static inline bool fits_leaf(const octree *tree, size_t count)
{
    return count <= tree->def.leaf_capacity;
}

/* octree_create() with a size of nodes, which is that of store_init(). */
octree_status create_tree(const octree_def *def, size_t node_size, octree **tree);

/* Check whether a position is finite and in the world. Returns OK, NULL_ARGUMENT, NOT_FINITE or OUTSIDE. */
octree_status check_position(const octree *tree, const double position[3]);

/* Check the position of a change of the tree. Returns the statuses of check_position(), or BUSY inside a callback of
 * the tree. */
static inline octree_status check_position_for_change(const octree *tree, const double position[3])
{
    const octree_status status = check_position(tree, position);
    return status == OCTREE_OK && is_running_callback(tree) ? OCTREE_BUSY : status;
}

/* Insert a point with a valid position and its Morton code. Returns OK, DUPLICATE, FULL, NO_MEMORY or TOO_MANY. If
 * `may_split` is false, the function returns FULL for a leaf at its capacity even if the leaf could split. Removing the
 * inserted point again then needs no memory. */
octree_status insert_point(octree *tree, const octree_point *point, uint64_t code, bool may_split);

/* Remove a point whose position is in the world. point->position becomes the stored position, in which zeros may have
 * other signs. Returns OK, NOT_FOUND or NO_MEMORY. */
octree_status remove_point(octree *tree, octree_point *point);

/* Remove an empty leaf from the group of its parent's children, and free the last unit of the group's block, which is
 * then unused. */
void remove_empty_child(octree *tree, node *parent, node *child);

/* After an insertion under OCTREE_AUTO, choose the capacity again if the tree has reached tuning.due points. If memory
 * runs out, the capacity stays the same. */
void tune_if_due(octree *tree);

/* Rebuild the tree with another definition. Errors: those of octree_create, OUTSIDE, FULL, NO_MEMORY; the tree is then
 * unchanged. */
octree_status rebuild_tree(octree *tree, const octree_def *def);

/* The nodes on the way from the root to the cell of a code. The last node is a leaf, or an inner node that has no child
 * in the code's octant. */
typedef struct path {
    node *nodes[OCTREE_MAX_DEPTH + 1];
    unsigned depth; /* the depth of the path's last node */
} path;

/* begin_path() makes a path that ends at the root. begin_path_beside() makes the path that begins with the nodes which
 * the path to another code shares with it. extend_path() continues a path towards a code, down to the last node that
 * exists. path_end() returns the last node of a path. find_path() returns the whole path to a code. */
static inline void begin_path(path *p, octree *tree)
{
    p->nodes[0] = &tree->root;
    p->depth = 0;
}

static inline void begin_path_beside(path *p, uint64_t code, const path *other, uint64_t other_code)
{
    p->nodes[0] = other->nodes[0];
    p->depth = 0;
    while (p->depth < other->depth && morton_octant(code, p->depth) == morton_octant(other_code, p->depth)) {
        p->depth++;
        p->nodes[p->depth] = other->nodes[p->depth];
    }
}

static inline node *path_end(const path *p)
{
    return p->nodes[p->depth];
}

void extend_path(path *p, uint64_t code);
path find_path(const octree *tree, uint64_t code);

/* Where a pair (position, id) is stored: the path to its leaf, and its index in the leaf. */
typedef struct found_point {
    path path;
    uint32_t index; /* the point's index in the leaf at the path's end */
} found_point;

static inline octree_point stored_point(const found_point *found)
{
    return leaf_points(path_end(&found->path))[found->index];
}

/* Find a pair (position, id). Returns false if the tree does not have the pair. */
bool find_point(const octree *tree, const double position[3], uint64_t id, found_point *found);

/* Insert a point that is not stored yet at the end of the path to its code. The last node of the path may then have new
 * nodes below. Returns the statuses of insert_point() but DUPLICATE. The change log must be off. Under OCTREE_AUTO the
 * caller calls tune_if_due(). */
octree_status insert_along_path(octree *tree, const path *p, const octree_point *point, uint64_t code);

/* Remove a point that was found, and shorten the path to the nodes that still exist. `code` is the point's Morton code.
 * Returns OK or NO_MEMORY. The change log must be off. */
octree_status remove_along_path(octree *tree, found_point *found, uint64_t code);

/* A removal whose memory is allocated before the point is removed. prepare_removal() returns OK, NOT_FOUND or
 * NO_MEMORY. If it returns OK, one of the other two functions must be called before the tree changes; they cannot
 * fail. */
typedef struct prepared_removal {
    found_point found;
    node spare;
} prepared_removal;

octree_status prepare_removal(octree *tree, const double position[3], uint64_t id, prepared_removal *r);
void make_removal(octree *tree, prepared_removal *r);
void cancel_removal(octree *tree, prepared_removal *r);

#endif
