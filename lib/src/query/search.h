/* search.h - what the queries with a choice of accuracy share. Private. */
#ifndef OCTREE_SEARCH_H
#define OCTREE_SEARCH_H

#include "meter.h"
#include "metric.h"
#include "tree.h"

#include <math.h>

/* The search that a null pointer stands for. */
octree_search search_or_default(const octree_search *how);

/* OK, BAD_OPTION, NOT_FINITE or BAD_SIZE. */
octree_status check_search(const octree_search *how);

/* NOT_FINITE when one of three coordinates is. */
octree_status check_finite(const double position[3]);

/* NULL_ARGUMENT, FLOAT_MODE, NOT_FINITE (a NaN) or BAD_RANGE. */
octree_status check_box(const octree_box *box);

/* True when a square is decided by as it is: in fast mode, but for squares that overflow, which say nothing. */
static inline bool is_trusted(octree_mode mode, double square)
{
    return mode == OCTREE_FAST && square < HUGE_VAL;
}

/* Is a point with this scaled square within a radius, whose scaled square is given too? */
static inline bool is_within(const metric *m, octree_mode mode, const octree_point *point, double square, double radius,
                             double radius_square)
{
    if (is_trusted(mode, square))
        return square <= radius_square;
    if (square < metric_below(radius_square))
        return true;
    return !(square > metric_above(radius_square)) && metric_compare_radius(m->target, point->position, radius) <= 0;
}

/* Visit every point in and below a node whose cell is inside a range. False when the visitor stopped. */
bool visit_all_below(const node *n, meter *m, octree_point_visitor visit, void *context);

#endif
