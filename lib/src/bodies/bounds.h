/* SPDX-License-Identifier: MIT */
/* bounds.h - lower bounds of distances and times for boxes that contain bodies. Private.
 *
 * A bound is certain in spite of rounding: no body in the box is nearer, or is touched earlier. Bounds are computed for
 * two boxes at once: for the two halves of a cell, which its octants share, or for two bodies of a leaf. A computation
 * that overflows excludes nothing.
 */
#ifndef OCTREE_BOUNDS_H
#define OCTREE_BOUNDS_H

#include "../exact/cast.h"
#include "cell.h"
#include "two_bodies.h"

/* A cast, prepared for bounds of times. */
typedef struct cast_axis {
    lanes origin, half, sign, inverse;
    lanes slack; /* an error of a time, as a multiple of the terms of its numerator */
    bool moves;
} cast_axis;

typedef struct cast_bounds {
    cast_axis axes[3];
    lanes length;
} cast_bounds;

cast_bounds make_cast_bounds(const cast *c);

/* Compute lower bounds for the bodies of the eight octants of a cell: of the squared distance from a target, both
 * multiplied by a power of two; and of the time at which a cast touches them, HUGE_VAL if it never does. */
void bound_squares_of_octants(const double target[3], double scale, const cell_halves *h, double bounds[8]);
void bound_times_of_octants(const cast_bounds *c, const cell_halves *h, double bounds[8]);

/* Compute the same bounds for the bodies of at most SCAN_POINTS points of a level. bounds[] has room for count + 1
 * numbers. Returns a bit mask of the bounds that are at most `cut`. */
uint64_t bound_squares_of_bodies(const double target[3], double scale, const level *l, const octree_point *points,
                                 unsigned count, double cut, double *bounds);
uint64_t bound_times_of_bodies(const cast_bounds *c, const level *l, const octree_point *points, unsigned count,
                               double cut, double *bounds);

/* Compute the same bounds for two bodies. */
lanes bound_squares_of_two(const double target[3], double scale, const two_bodies *two);
lanes bound_times_of_two(const cast_bounds *c, const two_bodies *two);

#endif
