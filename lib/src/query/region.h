/* SPDX-License-Identifier: MIT */
/* region.h - visiting the points in a region of space: a box, a ball, or the volume that a moving box sweeps. Private.
 *
 * A region is described by three functions of its `shape`. The traversal is depth first; a shape keeps its state
 * for the cell at each depth, so that a child's follows from its parent's.
 */
#ifndef OCTREE_REGION_H
#define OCTREE_REGION_H

#include "search.h"

/* How a region meets the octants of a cell, one bit per octant. */
typedef struct octant_masks {
    uint8_t meets;  /* the octant may intersect the region */
    uint8_t inside; /* the octant lies within the region */
} octant_masks;

/* Of the two halves of a cell on an axis: the octants in the lower one, and in the upper. */
static const uint8_t octants_beside[3][2] = {{0x0f, 0xf0}, {0x33, 0xcc}, {0x55, 0xaa}};

typedef struct region {
    const octree *tree;
    void *shape;
    /* The masks of a cell at a depth; it is the octant of the cell that was entered last at the depth above. */
    octant_masks (*enter)(void *shape, const octree *tree, unsigned depth, unsigned octant);
    /* Which of some points are in the region, a bit each; 1 <= count <= SCAN_POINTS. */
    uint64_t (*scan)(const void *shape, const octree_point *points, unsigned count);
    octree_point_visitor visit; /* null: points are counted */
    void *context;
    size_t count;
    meter meter;
} region;

/* Visit or count the points in a region, and report the cost. The masks are those of the root, in the lowest bit. */
void region_search(region *r, octant_masks root);

/* ---- A closed box ------------------------------------------------------------------------------------------- */

/* A box in keys, so that cells are compared by integers. Keys are monotone: a point whose key lies strictly between the
 * ends' keys lies in the box, and one whose key lies outside them does not. Where the box reaches the world's face, the
 * end is one key beyond all. */
typedef struct key_box {
    int32_t min[3], max[3];
} key_box;

typedef struct box_shape {
    const octree_box *box;
    key_box near;                     /* of the box: cells that do not meet it are pruned */
    key_box whole;                    /* of the box widened by epsilon: cells inside it are taken whole */
    int32_t low[OCTREE_MAX_DEPTH][3]; /* of the cell at each depth */
} box_shape;

/* The shape of a box; `whole` is that box, or one around it. */
box_shape box_shape_make(const octree *tree, const octree_box *box, const octree_box *whole);

/* For region_search. */
octant_masks box_shape_root(const box_shape *s, const octree *tree);
octant_masks box_shape_enter(void *shape, const octree *tree, unsigned depth, unsigned octant);
uint64_t box_shape_scan(const void *shape, const octree_point *points, unsigned count);

#endif
