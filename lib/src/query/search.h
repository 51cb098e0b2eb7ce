/* SPDX-License-Identifier: MIT */
/* search.h - functions that all queries share: argument checks, and counting and tracing the visited nodes. Private. */
#ifndef OCTREE_SEARCH_H
#define OCTREE_SEARCH_H

#include "../exact/bits.h"
#include "../exact/metric.h"
#include "../tree/tree.h"

#include <math.h>

#define SCAN_POINTS 64 /* the greatest number of points of a leaf that are compared in one call */

/* Return a copy of *how, or the default options if `how` is null. */
octree_search search_or_default(const octree_search *how);

/* Check that a position is finite. Returns OK or NOT_FINITE. */
static inline octree_status check_finite_position(const double position[3])
{
    return is_finite_position(position) ? OCTREE_OK : OCTREE_NOT_FINITE;
}

/* Check that a length is finite and not negative. Returns OK, NOT_FINITE, or BAD_SIZE for a negative length. */
static inline octree_status check_length(double length)
{
    return !isfinite(length) ? OCTREE_NOT_FINITE : length < 0 ? OCTREE_BAD_SIZE : OCTREE_OK;
}

/* Check the options of a search. Returns OK, BAD_OPTION, NOT_FINITE or BAD_SIZE. */
static inline octree_status check_search_options(const octree_search *how)
{
    if ((unsigned)how->skip > OCTREE_SKIP_COINCIDENT || (unsigned)how->mode > OCTREE_FAST)
        return OCTREE_BAD_OPTION;
    return check_length(how->epsilon);
}

/* Check a box. Returns OK, NULL_ARGUMENT, NOT_FINITE (a NaN) or BAD_RANGE (min > max). */
octree_status check_box(const octree_box *box);

/* Whether `size` bytes hold printable ASCII characters and a final zero. */
bool is_printable_text(const char *text, size_t size);

/* The maximum of two numbers that are not NaN. fmax() would be a function call. */
static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Return true if a square is compared as a double, without exact arithmetic. This is the case in FAST mode, unless the
 * square overflowed. */
static inline bool is_compared_as_double(octree_mode mode, double square)
{
    return mode == OCTREE_FAST && square < HUGE_VAL;
}

/* Whether a point is within a radius. `square` is the scaled squared distance of the point, `radius_square` the scaled
 * squared radius. The caller has already excluded points that are certainly outside the radius. */
static inline bool is_within_ball(const metric *m, octree_mode mode, const octree_point *point, double square,
                                  double radius, double radius_square)
{
    if (is_compared_as_double(mode, square))
        return square <= radius_square;
    if (square < metric_below(radius_square))
        return true;
    return metric_compare_radius(m->target, point->position, radius) <= 0;
}

/* A context for visit_unless_self(), which calls `visit` for all points except `self`. */
typedef struct collision {
    const octree_point *self; /* the colliding point itself, which is skipped; may be null */
    octree_point_visitor visit;
    void *context;
} collision;

bool visit_unless_self(const octree_point *point, void *context);

/* ---- Counts and trace ---------------------------------------------------------------------------------------- */

typedef struct meter {
    octree_cost count;
    const octree_search *how;
} meter;

static inline void meter_trace(const meter *m, octree_address address, octree_trace_kind kind)
{
    if (m->how->trace)
        m->how->trace(address, kind, m->how->trace_context);
}

/* Record a node whose children or points are examined one by one. */
static inline void meter_visit(meter *m, octree_address address)
{
    m->count.nodes++;
    meter_trace(m, address, OCTREE_TRACE_VISITED);
}

/* Record a node that is taken whole, because it is inside the region. */
static inline void meter_count_whole_node(meter *m, octree_address address)
{
    m->count.taken++;
    meter_trace(m, address, OCTREE_TRACE_TAKEN);
}

/* Record that the children in these octants are pruned, with all nodes below them. */
static inline void meter_prune(meter *m, octree_address parent, unsigned octants)
{
    m->count.pruned += bits_count8(octants);
    if (m->how->trace)
        for (unsigned octant = 0; octant < 8; octant++)
            if (octants >> octant & 1)
                meter_trace(m, parent << 3 | octant, OCTREE_TRACE_PRUNED);
}

/* Record that the root is pruned, so that no node is visited. */
static inline void meter_prune_root(meter *m)
{
    m->count.pruned++;
    meter_trace(m, OCTREE_ROOT, OCTREE_TRACE_PRUNED);
}

static inline void add_cost(octree_cost *sum, const octree_cost *cost)
{
    sum->nodes += cost->nodes;
    sum->leaves += cost->leaves;
    sum->points += cost->points;
    sum->pruned += cost->pruned;
    sum->taken += cost->taken;
}

/* Add the counts to the caller's octree_cost. */
static inline void meter_report(const meter *m)
{
    if (m->how->cost)
        add_cost(m->how->cost, &m->count);
}

#endif
