/* SPDX-License-Identifier: MIT */
/* box_faces.h - compares the faces of two boxes, all at once. Private. For two lanes only: lanes.h. */
#ifndef OCTREE_BOX_FACES_H
#define OCTREE_BOX_FACES_H

#include "../exact/lanes.h"
#include "octree/types.h"

#define ALL_FACES 0x3fu

/* Returns a mask of the six faces of a box that lie farther out than those of another. */
static inline unsigned find_faces_beyond(const octree_box *box, const octree_box *other)
{
    const lanes a = lanes_of(box->min[2], box->max[0]), b = lanes_of(other->min[2], other->max[0]);
    return lanes_less(lanes_load(&box->min[0]), lanes_load(&other->min[0])) | (lanes_less(a, b) & 1) << 2 |
           (lanes_less(b, a) & 2) << 2 | lanes_less(lanes_load(&other->max[1]), lanes_load(&box->max[1])) << 4;
}

static inline bool contains_box(const octree_box *around, const octree_box *box)
{
    return find_faces_beyond(box, around) == 0;
}

static inline bool is_same_box(const octree_box *a, const octree_box *b)
{
    return find_faces_beyond(a, b) == 0 && find_faces_beyond(b, a) == 0;
}

/* Extend a box so that it contains another. */
static inline void include_box(octree_box *around, const octree_box *box)
{
    lanes_store(&around->min[0], lanes_smaller(lanes_load(&box->min[0]), lanes_load(&around->min[0])));
    around->min[2] = box->min[2] < around->min[2] ? box->min[2] : around->min[2];
    around->max[0] = box->max[0] > around->max[0] ? box->max[0] : around->max[0];
    lanes_store(&around->max[1], lanes_larger(lanes_load(&box->max[1]), lanes_load(&around->max[1])));
}

#endif
