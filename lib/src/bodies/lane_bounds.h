/* SPDX-License-Identifier: MIT */
/* lane_bounds.h - bounds for the bodies of a leaf and for the boxes of siblings, for as many at once as there are
 * lanes.
 *
 * Most of the time of a search among bodies is spent here, so a body must cost few instructions. Bodies are computed
 * from the points of the leaf alone, with the numbers that bounds.c has prepared.
 *
 * Each source file that includes this header makes these functions for its number of lanes: bounds.c for two, and
 * bounds_avx2.c for four. Both have the same results.
 */
#ifndef OCTREE_LANE_BOUNDS_H
#define OCTREE_LANE_BOUNDS_H

#include "few_bodies.h"
#include "bounds.h"
#include "../query/search.h"

/* An axis of a query, with each number in all lanes. */
typedef struct axis_lanes {
    lanes origin, factor, step, rest, min, max, inner;
} axis_lanes;

static inline axis_lanes fill_lanes(const axis_bounds *a)
{
    return (axis_lanes){.origin = lanes_all(a->origin),
                        .factor = lanes_all(a->factor),
                        .step = lanes_all(a->step),
                        .rest = lanes_all(a->rest),
                        .min = lanes_all(a->min),
                        .max = lanes_all(a->max),
                        .inner = lanes_all(a->inner)};
}

/* The axes are copied, because they could be changed by storing bounds. */
typedef struct query_lanes {
    axis_lanes axes[3];
} query_lanes;

static inline query_lanes fill_all_lanes(const query_bounds *b)
{
    return (query_lanes){{fill_lanes(&b->axes[0]), fill_lanes(&b->axes[1]), fill_lanes(&b->axes[2])}};
}

/* ---- Distances ---------------------------------------------------------------------------------------------- */

static inline lanes reach_of_bodies(const axis_lanes *a, lanes steps)
{
    return lanes_add(lanes_multiply(steps, a->step), a->rest);
}

static inline lanes bound_gap(const axis_lanes *a, lanes center, lanes reach)
{
    const lanes offset = lanes_absolute(lanes_subtract(center, a->origin));
    return lanes_larger(lanes_multiply(lanes_subtract(offset, reach), a->factor), lanes_all(0));
}

/* The last term covers the underflow of squares. */
static inline lanes bound_few_squares(const query_lanes *q, const few_bodies *few)
{
    lanes sum = lanes_all(-0x1p-1000);
    for (int i = 0; i < 3; i++) {
        const lanes gap = bound_gap(&q->axes[i], few->position[i], reach_of_bodies(&q->axes[i], few->steps[i]));
        sum = lanes_add(sum, lanes_multiply(gap, gap));
    }
    return sum;
}

static uint64_t bound_squares(const query_bounds *b, const octree_point *points, unsigned count, double cut,
                              double *bounds)
{
    const query_lanes q = fill_all_lanes(b);
    uint64_t far = 0;
    for (unsigned i = 0; i < count; i += LANES) {
        const unsigned at = begin_of_group(count, i);
        const few_bodies few = load_few_bodies(points, count, at);
        const lanes squares = bound_few_squares(&q, &few);
        lanes_store(&bounds[at], squares);
        far |= (uint64_t)lanes_less(lanes_all(cut), squares) << at;
    }
    return ~far & UINT64_MAX >> (SCAN_POINTS - count);
}

/* The differences have only relative errors, which the factor covers. */
static unsigned bound_squares_of_boxes(const query_bounds *b, const sibling_boxes *boxes, double cut, double bounds[8])
{
    const query_lanes q = fill_all_lanes(b);
    unsigned far = 0;
    for (unsigned i = 0; i < boxes->count; i += LANES) {
        const unsigned at = begin_of_group(boxes->count, i);
        const few_boxes few = load_few_boxes(boxes, at);
        lanes sum = lanes_all(-0x1p-1000);
        for (int k = 0; k < 3; k++) {
            const axis_lanes *a = &q.axes[k];
            const lanes outside = lanes_larger(lanes_subtract(few.min[k], a->max), lanes_subtract(a->min, few.max[k]));
            const lanes gap = lanes_larger(lanes_multiply(outside, a->factor), lanes_all(0));
            sum = lanes_add(sum, lanes_multiply(gap, gap));
        }
        lanes_store(&bounds[at], sum);
        far |= lanes_less(lanes_all(cut), sum) << at;
    }
    return ~far & mask_of_siblings(boxes);
}

/* ---- Times -------------------------------------------------------------------------------------------------- */

/* The times at which bodies are touched, on the axes that were examined so far. */
typedef struct spans {
    lanes enter, leave;
} spans;

/* A time that is NaN excludes nothing. */
static inline void narrow_spans(spans *known, const axis_lanes *a, lanes center, lanes reach)
{
    const lanes middle = lanes_multiply(lanes_subtract(center, a->origin), a->factor);
    known->enter = lanes_larger(lanes_subtract(middle, reach), known->enter);
    known->leave = lanes_smaller(lanes_add(middle, reach), known->leave);
}

static uint64_t bound_times(const query_bounds *b, const octree_point *points, unsigned count, double cut,
                            double *bounds)
{
    const query_lanes q = fill_all_lanes(b);
    uint64_t far = 0;
    for (unsigned i = 0; i < count; i += LANES) {
        const unsigned at = begin_of_group(count, i);
        const few_bodies few = load_few_bodies(points, count, at);
        spans known = {lanes_all(0), lanes_all(b->length)};
        for (int k = 0; k < 3; k++)
            narrow_spans(&known, &q.axes[k], few.position[k], reach_of_bodies(&q.axes[k], few.steps[k]));
        lanes_store(&bounds[at], known.enter);
        far |= (uint64_t)lanes_less(lanes_smaller(lanes_all(cut), known.leave), known.enter) << at;
    }
    return ~far & UINT64_MAX >> (SCAN_POINTS - count);
}

/* Intersect with the times at which the moving box touches boxes on one axis. They have only relative errors. */
static inline void narrow_spans_of_boxes(spans *known, const axis_lanes *a, lanes min, lanes max)
{
    const lanes one = lanes_multiply(lanes_subtract(min, a->max), a->factor);
    const lanes other = lanes_multiply(lanes_subtract(max, a->min), a->factor);
    known->enter = lanes_larger(lanes_smaller(one, other), known->enter);
    known->leave = lanes_smaller(lanes_larger(one, other), known->leave);
}

/* Returns the spans with room for three roundings of a time on each side. */
static inline spans widen_spans(const spans *known)
{
    const lanes error =
        lanes_add(lanes_multiply(lanes_absolute(known->leave), lanes_all(0x1p-50)), lanes_all(0x1p-1000));
    const lanes enter = lanes_multiply(known->enter, lanes_all(1 - 0x1p-50));
    return (spans){lanes_subtract(enter, lanes_all(0x1p-1000)), lanes_add(known->leave, error)};
}

static unsigned bound_times_of_boxes(const query_bounds *b, const sibling_boxes *boxes, double cut, double bounds[8])
{
    const query_lanes q = fill_all_lanes(b);
    unsigned far = 0;
    for (unsigned i = 0; i < boxes->count; i += LANES) {
        const unsigned at = begin_of_group(boxes->count, i);
        const few_boxes few = load_few_boxes(boxes, at);
        spans known = {lanes_all(0), lanes_all(b->length)};
        for (int k = 0; k < 3; k++)
            narrow_spans_of_boxes(&known, &q.axes[k], few.min[k], few.max[k]);
        const spans wide = widen_spans(&known);
        lanes_store(&bounds[at], wide.enter);
        far |= lanes_less(lanes_smaller(lanes_all(cut), wide.leave), wide.enter) << at;
    }
    return ~far & mask_of_siblings(boxes);
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

static body_masks test_box(const query_bounds *b, const octree_point *points, unsigned count)
{
    const query_lanes q = fill_all_lanes(b);
    uint64_t apart = 0, sure = 0;
    for (unsigned i = 0; i < count; i += LANES) {
        const unsigned at = begin_of_group(count, i);
        const few_bodies few = load_few_bodies(points, count, at);
        lanes gap = lanes_all(0), excess = lanes_all(b->unsure);
        for (int k = 0; k < 3; k++) {
            const axis_lanes *a = &q.axes[k];
            const lanes offset = lanes_absolute(lanes_subtract(few.position[k], a->origin));
            const lanes way = lanes_subtract(offset, lanes_multiply(few.steps[k], a->step));
            gap = lanes_larger(lanes_subtract(way, a->rest), gap);
            excess = lanes_larger(lanes_subtract(way, a->inner), excess);
        }
        apart |= (uint64_t)lanes_less(lanes_all(0), gap) << at;
        sure |= (uint64_t)lanes_less(excess, lanes_all(0)) << at;
    }
    const uint64_t all = UINT64_MAX >> (SCAN_POINTS - count);
    return (body_masks){~apart & all, sure & all};
}

static unsigned test_boxes(const query_bounds *b, const sibling_boxes *boxes)
{
    const query_lanes q = fill_all_lanes(b);
    unsigned apart = 0;
    for (unsigned i = 0; i < boxes->count; i += LANES) {
        const unsigned at = begin_of_group(boxes->count, i);
        const few_boxes few = load_few_boxes(boxes, at);
        lanes gap = lanes_all(0);
        for (int k = 0; k < 3; k++) {
            gap = lanes_larger(lanes_subtract(few.min[k], q.axes[k].max), gap);
            gap = lanes_larger(lanes_subtract(q.axes[k].min, few.max[k]), gap);
        }
        apart |= lanes_less(lanes_all(0), gap) << at;
    }
    return ~apart & mask_of_siblings(boxes);
}

/* The initializer of bound_functions. */
#define BOUND_FUNCTIONS bound_squares, bound_times, test_box, bound_squares_of_boxes, bound_times_of_boxes, test_boxes

#endif
