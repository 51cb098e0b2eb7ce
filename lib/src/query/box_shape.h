/* box_shape.h - a closed box as a region of space (region.h): in keys, so that nodes are compared by integers. Private.
 */
#ifndef OCTREE_BOX_SHAPE_H
#define OCTREE_BOX_SHAPE_H

#include "region.h"

/* A box in keys. Keys are monotone, so a point whose key lies strictly between the ends' keys lies in the box, and one
 * whose key lies outside them does not. Where the box reaches the world's face, the end is one key beyond all. */
typedef struct key_box {
    int32_t min[3], max[3];
} key_box;

typedef struct box_shape {
    const octree_box *box;
    key_box near;                     /* of the box: what does not meet it is left out */
    key_box whole;                    /* of the box moved out by epsilon: what is inside is taken whole */
    int32_t low[OCTREE_MAX_DEPTH][3]; /* of the cell at each depth */
} box_shape;

/* The shape of a box; `whole` is that box, or one around it. */
box_shape box_shape_make(const octree *tree, const octree_box *box, const octree_box *whole);

/* Of the root, for region_descend. */
octant_masks box_shape_root(const box_shape *s, const octree *tree);

/* For region.enter and region.scan. */
octant_masks box_shape_enter(void *shape, const octree *tree, unsigned depth, unsigned octant);
unsigned box_shape_scan(const void *shape, const octree_point *points, unsigned count, uint8_t hits[]);

#endif
