/* SPDX-License-Identifier: MIT */
/* snapshot.h - a copy of the nodes and bodies of one level, for algorithms that compare many bodies with many. Private.
 */
#ifndef OCTREE_SNAPSHOT_H
#define OCTREE_SNAPSHOT_H

#include "set.h"

/* A node: the tight box and the range of its bodies. */
typedef struct group {
    octree_box box;
    size_t first, count;  /* the range of its bodies */
    size_t child;         /* the index of its first child; children are adjacent */
    unsigned child_count; /* 0: a leaf */
} group;

/* Boxes of bodies, with rounded faces, as one array for each face. */
typedef struct box_columns {
    double *min[3], *max[3];
} box_columns;

typedef struct snapshot {
    arena *memory;
    list groups;         /* of groups; the first is the root */
    octree_body *bodies; /* in the order of the leaves; those of a leaf are sorted by octree_compare_bodies() */
    box_columns boxes;   /* the boxes of the bodies, in the same order, and one more that is not used */
    size_t room;         /* the number of bodies for which memory is allocated */
} snapshot;

/* The greatest number of boxes that one call of find_meeting_boxes() compares. */
enum { BOXES_AT_ONCE = 64 };

/* Copy a level. Returns false if memory runs out. The caller releases the snapshot in both cases. Cost: O(n log M). */
bool snapshot_make(snapshot *s, const octree_bodies *set, const level *l, arena *memory);
void snapshot_release(snapshot *s);

static inline const group *group_at(const snapshot *s, size_t index)
{
    return (const group *)s->groups.items + index;
}

/* Returns a bit mask of the boxes first .. first + count - 1 that meet a box. count <= BOXES_AT_ONCE; one box more is
 * read. */
uint64_t find_meeting_boxes(const box_columns *boxes, size_t first, size_t count, const octree_box *box);

static inline octree_box box_in_columns(const box_columns *boxes, size_t index)
{
    return (octree_box){{boxes->min[0][index], boxes->min[1][index], boxes->min[2][index]},
                        {boxes->max[0][index], boxes->max[1][index], boxes->max[2][index]}};
}

#endif
