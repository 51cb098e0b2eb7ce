/* search.h - what the queries with a choice of accuracy share. Private. */
#ifndef OCTREE_SEARCH_H
#define OCTREE_SEARCH_H

#include "metric.h"
#include "tree.h"

#include <math.h>

/* The search that a null pointer stands for. */
octree_search search_or_default(const octree_search *how);

/* OK, BAD_OPTION, NOT_FINITE or BAD_SIZE. */
octree_status check_search(const octree_search *how);

/* NOT_FINITE when one of three coordinates is. */
octree_status check_finite(const double position[3]);

/* True when the squares alone say that a is less: in exact mode beyond the reach of rounding. */
static inline bool surely_less(octree_mode mode, double a, double b)
{
    return mode == OCTREE_FAST ? a < b : metric_surely_less(a, b);
}

/* True when a square is decided by as it is: in fast mode, but for squares that overflow, which say nothing. */
static inline bool is_trusted(octree_mode mode, double square)
{
    return mode == OCTREE_FAST && square < HUGE_VAL;
}

/* Counts go to the caller's report, or here where there is none. */
static inline octree_cost *cost_or(const octree_search *how, octree_cost *unused)
{
    *unused = (octree_cost){0};
    return how->cost ? how->cost : unused;
}

/* Visit every point in and below a node. False when the visitor stopped. */
bool visit_all_below(const node *n, octree_cost *cost, octree_point_visitor visit, void *context);

#endif
