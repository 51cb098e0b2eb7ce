/* SPDX-License-Identifier: MIT */
/* bounds.h - lower bounds of distances and times for the bodies of a leaf and the boxes of nodes. Private.
 *
 * A bound is certain in spite of rounding: no body is nearer, or is touched earlier. A computation that overflows
 * excludes nothing; no bound is NaN. A query is prepared once for each level; then a body costs some 30 instructions.
 */
#ifndef OCTREE_BOUNDS_H
#define OCTREE_BOUNDS_H

#include "../exact/cast.h"
#include "boxes.h"

/* A query on one axis. The half extent of a body, with all that is added to it, is at most `steps * step + rest`;
 * `steps` is in the id of the body's point (few_bodies.h). */
typedef struct axis_bounds {
    double origin, factor;
    double step, rest;
    double min, max; /* the extent of the query: of the target, the region or the moving box at its origin */
    double inner; /* only for boxes: a body certainly meets the box if its distance - steps * step is less than this */
} axis_bounds;

typedef struct query_bounds {
    axis_bounds axes[3];
    double length; /* only for times */
    double unsure; /* only for boxes: HUGE_VAL if no body certainly meets the box, otherwise -HUGE_VAL */
    const struct bound_functions *in_lanes; /* the functions for this processor */
} query_bounds;

/* The bodies of at most SCAN_POINTS points that may meet a region, and those that certainly do, as bit masks. */
typedef struct body_masks {
    uint64_t near, sure;
} body_masks;

/* Bounds for many bodies or boxes at once (lane_bounds.h). */
typedef struct bound_functions {
    /* Compute bounds for at most SCAN_POINTS points. bounds[] has room for SCAN_POINTS. Return a bit mask of the bodies
     * whose bounds are at most `cut`; other bodies have no valid bound. */
    uint64_t (*squares)(const query_bounds *b, const octree_point *points, unsigned count, double cut, double *bounds);
    uint64_t (*times)(const query_bounds *b, const octree_point *points, unsigned count, double cut, double *bounds);
    body_masks (*meets)(const query_bounds *b, const octree_point *points, unsigned count);
    /* The same for the boxes of siblings: bounds[i] is for the bodies of sibling i. Return a bit mask of siblings. */
    unsigned (*squares_of_boxes)(const query_bounds *b, const sibling_boxes *boxes, double cut, double bounds[8]);
    unsigned (*times_of_boxes)(const query_bounds *b, const sibling_boxes *boxes, double cut, double bounds[8]);
    unsigned (*boxes_meet)(const query_bounds *b, const sibling_boxes *boxes);
} bound_functions;

extern const bound_functions bounds_in_two_lanes;
#ifdef OCTREE_AVX2
extern const bound_functions bounds_in_four_lanes;
#endif

/* Prepare bounds of squared distances from a target, multiplied by the square of the tree's scale. */
void prepare_squares(query_bounds *b, const level *l, const double target[3]);

/* Prepare bounds of the times at which a cast touches a body. */
void prepare_times(query_bounds *b, const level *l, const cast *c);

/* Prepare the test whether a body meets a box. Corners of the box may be infinite. */
void prepare_box_test(query_bounds *b, const level *l, const octree_box *box);

#endif
