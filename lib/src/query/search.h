/* SPDX-License-Identifier: MIT */
/* search.h - what all queries share: checks of arguments, and a meter that counts the work of a search and traces its
 * nodes. Private. */
#ifndef OCTREE_SEARCH_H
#define OCTREE_SEARCH_H

#include "../exact/bits.h"
#include "../exact/metric.h"
#include "../tree/tree.h"

#include <math.h>

#define SCAN_POINTS 64 /* the greatest number of points of a leaf that are compared in one call */

/* Returns the number of points that one such call compares, of a leaf from an index on. */
static inline unsigned count_scanned(const node *leaf, uint32_t begin)
{
    return leaf->count - begin < SCAN_POINTS ? leaf->count - begin : SCAN_POINTS;
}

/* Returns a copy of *how, or the default options if `how` is null. */
octree_search search_or_default(const octree_search *how);

/* Check that a position is finite. Returns OK or NOT_FINITE. */
static inline octree_status check_finite_position(const double position[3])
{
    return is_finite_position(position) ? OCTREE_OK : OCTREE_NOT_FINITE;
}

/* Check a direction. Returns OK, NOT_FINITE, or BAD_SIZE if it is zero. */
static inline octree_status check_direction(const double v[3])
{
    const octree_status status = check_finite_position(v);
    return status == OCTREE_OK && v[0] == 0 && v[1] == 0 && v[2] == 0 ? OCTREE_BAD_SIZE : status;
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

/* Returns whether `text` consists of printable ASCII characters and ends with a zero byte within `size` bytes. */
bool is_printable_text(const char *text, size_t size);

/* Returns the larger of two numbers that are not NaN. fmax() would be a function call. */
static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Returns whether a squared distance is compared as a double, without exact arithmetic. This is the case in FAST mode,
 * unless the squared distance overflowed. */
static inline bool is_compared_as_double(octree_mode mode, double square)
{
    return mode == OCTREE_FAST && square < HUGE_VAL;
}

/* Returns whether a point lies within `radius` of the metric's target. `square` is the scaled squared distance of the
 * point, `radius_square` the square of the scaled radius. The caller has already excluded points that are certainly
 * outside the radius. */
static inline bool is_within_ball(const metric *m, octree_mode mode, const octree_point *point, double square,
                                  double radius, double radius_square)
{
    if (is_compared_as_double(mode, square))
        return square <= radius_square;
    if (square < metric_below(radius_square))
        return true;
    return metric_compare_radius(m->target, point->position, radius) <= 0;
}

/* The context of visit_unless_self(), an octree_point_visitor that calls `visit` for every point except `self`. */
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

static inline void meter_call_tracer(const meter *m, octree_address address, octree_trace_kind kind)
{
    if (m->how->trace)
        m->how->trace(address, kind, m->how->trace_context);
}

/* Count and trace a node whose children or points are examined one by one. */
static inline void meter_record_visited(meter *m, octree_address address)
{
    m->count.nodes++;
    meter_call_tracer(m, address, OCTREE_TRACE_VISITED);
}

/* Count and trace a node that is taken whole, because its cell is inside the region. */
static inline void meter_record_taken(meter *m, octree_address address)
{
    m->count.taken++;
    meter_call_tracer(m, address, OCTREE_TRACE_TAKEN);
}

/* Count and trace children that are pruned, with all nodes below them. `octants` is a bit mask of the octants of the
 * children. */
static inline void meter_record_pruned(meter *m, octree_address parent, unsigned octants)
{
    m->count.pruned += bits_count8(octants);
    if (m->how->trace)
        for (unsigned octant = 0; octant < 8; octant++)
            if (octants >> octant & 1)
                meter_call_tracer(m, parent << 3 | octant, OCTREE_TRACE_PRUNED);
}

/* Count and trace the root as pruned; no node is visited then. */
static inline void meter_record_pruned_root(meter *m)
{
    m->count.pruned++;
    meter_call_tracer(m, OCTREE_ROOT, OCTREE_TRACE_PRUNED);
}

static inline void add_cost(octree_cost *sum, const octree_cost *cost)
{
    sum->nodes += cost->nodes;
    sum->leaves += cost->leaves;
    sum->points += cost->points;
    sum->pruned += cost->pruned;
    sum->taken += cost->taken;
}

/* Add the counts to the caller's octree_cost, if the caller wants the cost. */
static inline void meter_add_to_cost(const meter *m)
{
    if (m->how->cost)
        add_cost(m->how->cost, &m->count);
}

#endif
