/* SPDX-License-Identifier: MIT */
/* region.h - visits the points in a region of space: a box, a ball, or the volume that a moving box sweeps. Private.
 *
 * The traversal of the nodes is the same for all regions; a region supplies a `shape` with two functions, enter and
 * scan. The traversal is depth first. A shape keeps state for the current cell of each depth, so that a child's state
 * is computed from its parent's.
 */
#ifndef OCTREE_REGION_H
#define OCTREE_REGION_H

#include "search.h"
#include "../tree/leaf.h"

/* The relation between the octants of a cell and a region. Each mask has one bit per octant. */
typedef struct octant_masks {
    uint8_t meets;  /* the octant may intersect the region */
    uint8_t inside; /* the octant lies within the region */
} octant_masks;

/* octants_beside[axis][half]: a bit mask of the octants in the lower half (0) or the upper half (1) of a cell. */
static const uint8_t octants_beside[3][2] = {{0x0f, 0xf0}, {0x33, 0xcc}, {0x55, 0xaa}};

typedef struct region {
    const octree *tree;
    void *shape;
    /* Returns the masks of the cell of an inner node at a depth. The cell is the given octant of the cell that was last
     * entered one level above. */
    octant_masks (*enter)(void *shape, const octree *tree, unsigned depth, unsigned octant);
    /* Returns a bit mask of the points that are in the region: bit i is for points[i]. 1 <= count <= SCAN_POINTS. */
    uint64_t (*scan)(const void *shape, const octree_point *points, unsigned count);
    octree_point_visitor visit; /* null: the points are counted, but not visited */
    void *context;
    size_t count;
    meter meter;
} region;

/* Visit or count the points in a region and report the cost. `root` describes the root's cell itself, by bit 0 of each
 * mask. */
void region_search(region *r, octant_masks root);

/* ---- Leaves ------------------------------------------------------------------------------------------------- */

/* The leaves that a descent has reached. While the points of a leaf are loaded from memory, the leaf waits in the queue
 * and the descent continues. */
enum { LEAF_QUEUE_ROOM = 16 };

typedef struct leaf_queue {
    unsigned added, removed; /* the number of leaves so far */
    const node *leaves[LEAF_QUEUE_ROOM];
} leaf_queue;

static inline bool leaf_queue_is_full(const leaf_queue *q)
{
    return q->added - q->removed == LEAF_QUEUE_ROOM;
}

/* Add a leaf to a queue that is not full, and start to load its points. */
static inline void leaf_queue_add(leaf_queue *q, const node *leaf)
{
    leaf_prefetch(leaf);
    q->leaves[q->added++ % LEAF_QUEUE_ROOM] = leaf;
}

static inline const node *leaf_queue_remove(leaf_queue *q)
{
    return q->leaves[q->removed++ % LEAF_QUEUE_ROOM];
}

/* ---- A closed box ------------------------------------------------------------------------------------------- */

/* A box of integer keys (plane.h), so that cells are compared with integers. A key ascends with its coordinate. On each
 * axis, a point is inside if its key is strictly between the keys of the box's two faces, and outside if its key is
 * beyond one of them. If its key equals the key of a face, the coordinates decide. A face at or beyond the world's face
 * has a key that no coordinate in the world has: -1 or PLANE_GRID. */
typedef struct key_box {
    int32_t min[3], max[3];
} key_box;

typedef struct box_shape {
    const octree_box *box;
    key_box near; /* the keys of the box: a cell that does not meet this box is pruned */
    /* the keys of another box: a node whose cell is inside this box is taken whole */
    key_box whole;
    int32_t low[OCTREE_MAX_DEPTH][3]; /* low[d]: the lowest keys of the current cell of depth d */
} box_shape;

/* Make the shape of a box. A node is taken whole if its cell is in `whole`: the same box, or one widened by epsilon. */
box_shape box_shape_make(const octree *tree, const octree_box *box, const octree_box *whole);

/* The functions of a box's shape, for region_search(). */
octant_masks box_shape_root(const box_shape *s, const octree *tree);
octant_masks box_shape_enter(void *shape, const octree *tree, unsigned depth, unsigned octant);
uint64_t box_shape_scan(const void *shape, const octree_point *points, unsigned count);

#endif
