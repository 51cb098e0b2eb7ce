/* SPDX-License-Identifier: MIT */
/* snapshot.h - the nodes and bodies of one level in arrays, for algorithms that compare many bodies with many. Private.
 */
#ifndef OCTREE_SNAPSHOT_H
#define OCTREE_SNAPSHOT_H

#include "float_box.h"
#include "set.h"

/* The bodies of a node: their tight box and their range. A cluster without children may be several leaves of the tree.
 */
typedef struct cluster {
    float_box box;
    unsigned child_count; /* 0: a leaf of the snapshot */
    size_t first, count;  /* the range of its bodies */
    size_t child;         /* the index of its first child; children are adjacent */
} cluster;

/* Faces are multiplied by `scale` after `origin` is subtracted. */
typedef struct float_frame {
    double origin[3], scale[3];
} float_frame;

typedef struct snapshot {
    arena *memory;
    float_frame frame;
    size_t capacity;            /* a leaf is not divided, nor is a node with at most this number of bodies */
    list clusters;              /* of clusters; the first is the root */
    unsigned depth;             /* of the deepest cluster */
    size_t leaf_count;          /* the number of clusters without children */
    const octree_body **bodies; /* in the order of the leaves of the tree, and in each leaf sorted */
    octree_body *made;          /* the bodies of a set that shows points, which has no rows; else null */
    box_columns boxes;          /* the boxes of the bodies, in the same order, and BOX_PADDING more that are not used */
    size_t room;                /* the number of bodies for which memory is allocated */
} snapshot;

/* Make the frame for the common part of two worlds. Boxes can be compared if they have the same frame. */
float_frame make_float_frame(const octree_box *world, const octree_box *other);

/* Make the snapshot of a level. Returns false if memory runs out. The caller releases the snapshot in both cases. Cost:
 * O(n M). */
bool snapshot_make(snapshot *s, const octree_bodies *set, const level *l, const float_frame *frame, arena *memory);
void snapshot_release(snapshot *s);

static inline const cluster *cluster_at(const snapshot *s, size_t index)
{
    return (const cluster *)s->clusters.items + index;
}

#endif
