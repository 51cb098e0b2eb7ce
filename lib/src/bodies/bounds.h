/* SPDX-License-Identifier: MIT */
/* bounds.h - lower bounds of distances and times for boxes that contain bodies. Private.
 *
 * A bound is certain in spite of rounding: no body in the box is nearer, or is touched earlier. Bounds are computed
 * axis by axis, because the octants of a cell share their halves. A computation that overflows excludes nothing.
 */
#ifndef OCTREE_BOUNDS_H
#define OCTREE_BOUNDS_H

#include "../exact/cast.h"
#include "cell.h"

/* Returns a lower bound of the distance on one axis from a target to the interval center +- half. Three roundings of at
 * most 2^-53 * (offset + half) each are subtracted. */
static inline double bound_gap(double target, double center, double half)
{
    const double offset = fabs(target - center), gap = (offset - half) - (offset + half) * 0x1p-50;
    return gap > 0 ? gap : 0; /* also if the gap is NaN */
}

/* Returns a lower bound of a sum of three squares. A sum near overflow is cut. */
static inline double bound_square(double x, double y, double z)
{
    const double sum = (x * x + y * y) + z * z;
    const double bound = sum < 0x1p1020 ? sum * (1 - 0x1p-50) - 0x1p-1000 : 0x1p1020;
    return bound > 0 ? bound : 0;
}

/* The interval of time in which a moving box touches the bodies in a box, rounded outwards. */
typedef struct time_span {
    double enter, leave;
} time_span;

/* Intersect a span with the times at which the cast touches the interval center +- half on one axis. */
static inline void narrow_span(time_span *span, const cast *c, int axis, double center, double half)
{
    const double offset = center - c->origin[axis], reach = half + c->half[axis];
    if (c->sign[axis] == 0) {
        if (fabs(offset) - reach > (fabs(offset) + reach) * 0x1p-50)
            span->enter = HUGE_VAL;
        return;
    }
    const double way = c->sign[axis] * offset, inverse = c->inverse[axis];
    const double error = (fabs(way) + reach) * inverse * 0x1p-49 + 0x1p-1000;
    const double enter = (way - reach) * inverse - error, leave = (way + reach) * inverse + error;
    span->enter = enter > span->enter ? enter : span->enter; /* unchanged if `enter` is NaN */
    span->leave = leave < span->leave ? leave : span->leave;
}

/* Returns whether a span has no time. */
static inline bool is_span_empty(const time_span *span)
{
    return span->enter > span->leave || span->enter > DBL_MAX;
}

/* Compute lower bounds for the bodies of the eight octants of a cell: of the squared distance from a target, both
 * multiplied by a power of two; and of the time at which a cast touches them, HUGE_VAL if it never does. */
void bound_squares_of_octants(const double target[3], double scale, const cell_halves *h, double bounds[8]);
void bound_times_of_octants(const cast *c, const cell_halves *h, double bounds[8]);

/* Returns the begin of a span, or HUGE_VAL if the span has no time. */
static inline double begin_of_span(const time_span *span)
{
    return is_span_empty(span) ? HUGE_VAL : span->enter;
}

#endif
