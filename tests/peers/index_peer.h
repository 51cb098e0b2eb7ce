/* SPDX-License-Identifier: MIT */
/* index_peer.h - one face for other people's indexes whose answers are judged, with faults that can be planted in them.
 *
 * The bench's peers add up what they find, and are as their libraries come: these name the points, hold doubles or
 * floats, and move points. Doubles are compared by sums in long double: of some million
 * neighbours none is named in another's place.
 */
#ifndef INDEX_PEER_H
#define INDEX_PEER_H

#include "octree/game.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One line per fault: its name and what it is. */
#define PLANTED_FAULT_MAP(X)                                                                                           \
    X(NONE, "none", "as it should be")                                                                                 \
    X(BOUND, "bound", "a bound is that of the place before: the last cell, the k-th distance, the third axis")         \
    X(CHILD, "child", "a child is skipped: a cell, or what is beyond a plane")                                         \
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

typedef struct index_peer {
    const char *name;
    octree_precision precision;
    unsigned kinds;  /* of queries, as bits 1 << octree_query_kind */
    unsigned faults; /* that can be planted, as bits 1 << planted_fault */
    /* Of so many points at most, all with ids below that. */
    void *(*create)(const octree_point *points, size_t count, planted_fault fault);
    void (*destroy)(void *self);
    /* Points have moved: all of them as they are now, in the order of create. */
    void (*update)(void *self, const octree_point *points);
    /* The ids of the answer, of which there is room for all points; returns their number. */
    size_t (*ask)(const void *self, const octree_query *query, uint64_t *ids);
} index_peer;

extern const index_peer nanoflann_doubles, nanoflann_floats, boost_doubles, boost_floats, grid_doubles, grid_floats;

/* What the peers promise: of neighbours those of floats as octreel help session says, and those of doubles all; of a
 * ball's radius this share beyond it. */
#define FLOAT_RATIO 4e-7
#define FLOAT_REACH 2e-6
#define DOUBLE_REACH 2e-15

#ifdef __cplusplus
}
#endif

#endif
