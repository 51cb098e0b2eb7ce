/* SPDX-License-Identifier: MIT */
/* sweep.h - decides whether a moving box touches a moving body. */
#ifndef OCTREE_SWEEP_H
#define OCTREE_SWEEP_H

#include <stdbool.h>

/* A box that moves in a straight line during the time 0..1. Its centre moves from `from` to `to`. On each axis the box
 * extends by `size` from its centre to both sides. All values are finite, and size >= 0. */
typedef struct sweep {
    const double *from, *to;
    double size;
} sweep;

/* Returns whether the box touches, at some moment of 0..1, a body that moves in a straight line from `from` to `to`.
 * The two positions are equal for a body at rest. `half` has the half extents of the body; null: the body is a point.
 * The result is exact for all finite values. */
bool sweep_touches(const sweep *box, const double from[3], const double to[3], const double half[3]);

#endif
