/* SPDX-License-Identifier: MIT */
/* faulty_index.h - an index whose points move, and in which a fault can be planted. */
#ifndef FAULTY_INDEX_H
#define FAULTY_INDEX_H

#include "index.h"

/* One line per fault: its name and what it is. */
#define PLANTED_FAULT_MAP(X)                                                                                           \
    X(NONE, "none", "the index as its library comes")                                                                  \
    X(BOUND, "bound",                                                                                                  \
      "the k-th neighbour is the one after it, and the third axis of a box has the bound of the second")               \
    X(CHILD, "child", "a cell is skipped")                                                                             \
    X(ROUNDED, "rounded", "points are stored as floats, and doubles are promised")                                     \
    X(STALE, "stale", "some points that move stay in their old leaf")                                                  \
    X(STRICT, "strict", "< in place of <= where a box or a ball ends")                                                 \
    X(FEWER, "fewer", "k - 1 of k neighbours")

typedef enum planted_fault {
#define PLANTED_FAULT_ENUM(name, word, meaning) PLANTED_##name,
    PLANTED_FAULT_MAP(PLANTED_FAULT_ENUM)
#undef PLANTED_FAULT_ENUM
        PLANTED_FAULTS
} planted_fault;

typedef struct faulty_index faulty_index;

/* Build an index of points with the ids 0, 1, 2 ... in a world. Returns null if the library refuses the points. */
faulty_index *faulty_index_create(const spatial_index *index, planted_fault fault, const octree_point *points,
                                  size_t count, const octree_box *world);
void faulty_index_destroy(faulty_index *f);

/* All points have moved to the positions that they have now. */
void faulty_index_update(faulty_index *f, const octree_point *points);

/* The ids of the answer, with room for all points and one more. Returns their number. */
size_t faulty_index_ask(const faulty_index *f, const octree_query *query, uint64_t *ids);

#endif
