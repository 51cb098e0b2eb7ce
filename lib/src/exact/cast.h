/* SPDX-License-Identifier: MIT */
/* cast.h - decides in real numbers when a box that moves in a straight line first touches a body at rest. */
#ifndef OCTREE_CAST_H
#define OCTREE_CAST_H

#include "body.h"

/* The motion of a box: its centre is origin + t * direction for 0 <= t <= length. A ray is a box without extent. */
typedef struct cast {
    double origin[3];
    double step[3][2]; /* on each axis, the direction is the real sum of these two terms */
    double half[3];    /* the half extents of the moving box */
    double length;     /* the largest parameter t; HUGE_VAL: there is none */
    int sign[3];       /* the sign of the direction on each axis: -1, 0 or 1 */
    double speed[3];   /* the absolute value of the direction on each axis, with a relative error of at most 2^-53 */
    double inverse[3]; /* 1 / speed, rounded; infinite if the speed is 0 or tiny, NaN if it is above 2^1000 */
} cast;

/* Make the cast of a ray with a thickness, and of a box that moves from one position to another (t from 0 to 1). All
 * values are finite, only `length` may be infinite. */
cast cast_make_ray(const double origin[3], const double direction[3], double length, const double half[3]);
cast cast_make_sweep(const double from[3], const double to[3], const double half[3]);

/* The parameter at which a cast first touches a body, in doubles. The real parameter is at most `error` from `value`;
 * the error is 0 if the cast certainly begins inside the body. */
typedef struct cast_time {
    double value, error;
} cast_time;

/* Returns whether the moving box touches the body. If so, *first receives the first time of contact; its error is
 * infinite if doubles do not bound it. Exact for all finite values. */
bool cast_touches(const cast *c, const octree_body *e, cast_time *first);

/* Returns the sign of the first time of contact with `a` minus that with `b`: -1, 0 or 1. The cast touches both. */
int cast_compare(const cast *c, const octree_body *a, const octree_body *b);

/* Returns the first time of contact with a body that the cast touches, within 4 ulp: each of three roundings may add a
 * little more than one. */
double cast_first_time(const cast *c, const octree_body *e);

#endif
