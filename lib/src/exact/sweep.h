/* SPDX-License-Identifier: MIT */
/* sweep.h - whether a moving box touches a moving point. */
#ifndef OCTREE_SWEEP_H
#define OCTREE_SWEEP_H

#include <stdbool.h>

/* The box position +- size, moving in a straight line from one position to another during the time 0..1. All finite,
 * size >= 0. */
typedef struct sweep {
    const double *from, *to;
    double size;
} sweep;

/* Whether the box touches, at some time of 0..1, a point that moves in a straight line from one position to another
 * (both the same for a point at rest). Decided by the real numbers. */
bool sweep_touches(const sweep *box, const double from[3], const double to[3]);

#endif
