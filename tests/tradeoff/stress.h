/* SPDX-License-Identifier: MIT */
/* stress.h - points and queries at which indexes break. */
#ifndef TRADEOFF_STRESS_H
#define TRADEOFF_STRESS_H

#include "apart.h"

enum { STRESS_POINTS = 200, STRESS_QUERIES = 24 };

/* How positions lie. */
typedef enum stress_kind {
    STRESS_CUBE,     /* anywhere in a cube */
    STRESS_GRAINS,   /* on a fine grid far from the origin */
    STRESS_TENTHS,   /* multiples of 0.1, which doubles round; targets halfway between them */
    STRESS_WHOLE,    /* whole numbers; targets on them, and regions that end on them */
    STRESS_FEW,      /* three places for all points */
    STRESS_EMPTY,    /* no points */
    STRESS_NAN,      /* a coordinate of one point is NaN */
    STRESS_INFINITY, /* a coordinate of one point is infinite */
} stress_kind;

typedef struct stress {
    const char *name, *about;
    stress_kind kind;
    double offset, extent; /* of the cube */
    double grain;
    apart_program program;
    bool flush;
} stress;

extern const stress stresses[];
extern const size_t stress_count;

/* Points with the ids 0, 1, 2 ..., their world, and queries of one kind. */
typedef struct stress_set {
    octree_box world;
    octree_point points[STRESS_POINTS];
    size_t count;
    octree_query queries[STRESS_QUERIES];
    bool finite; /* all coordinates are numbers */
} stress_set;

void stress_make(const stress *s, octree_query_kind kind, stress_set *set);

#endif
