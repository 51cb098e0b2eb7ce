/* sweep.h - does a box on its way touch a point on its way? Private. */
#ifndef OCTREE_SWEEP_H
#define OCTREE_SWEEP_H

#include <stdbool.h>

/* A box position +- size that goes straight from one place to another in a unit of time. All finite, size >= 0. */
typedef struct sweep {
    const double *from, *to;
    double size;
} sweep;

/* Whether the box touches, at some time of 0..1, a point that goes straight from one place to another in that time; a
 * point at rest has one place for both. Decided by the real numbers. */
bool sweep_touches(const sweep *box, const double from[3], const double to[3]);

#endif
