/* SPDX-License-Identifier: MIT */
/* point_sets.h - sets of points, and queries about them, of kinds at which indexes often give wrong answers. */
#ifndef POINT_SETS_H
#define POINT_SETS_H

#include "octree/game.h"

typedef struct point_set {
    const char *name, *about;
    bool in_floats; /* true: the squares of its distances are exact as floats */
    size_t least, most;
    octree_box world;
    void (*place)(uint64_t *random, double at[3]);
} point_set;

#define POINT_SETS 8
extern const point_set point_sets[POINT_SETS];

/* Make a random number of points, set->least to set->most, with the ids 0, 1, 2 ... Returns the number. */
#define POINT_SET_MOST 300
size_t point_set_fill(const point_set *set, uint64_t *random, octree_point *points);

/* A query of this kind, with targets and bounds that are often those of points. */
octree_query point_set_ask(const point_set *set, uint64_t *random, octree_query_kind kind, const octree_point *points,
                           size_t count);

#endif
