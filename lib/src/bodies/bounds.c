/* SPDX-License-Identifier: MIT */
/* bounds.c - lower bounds of distances and times for the bodies of a leaf, the boxes of nodes, and the octants of
 * cells.
 *
 * Most of the time of a search among bodies is spent here, so a body must cost few instructions. Two bodies are
 * computed at once, from the points of the leaf alone. Everything that is the same for all bodies of a level is folded
 * into two numbers an axis: a body's half extent, with the extent of the query and a bound of all rounding errors, is
 * at most steps * step + rest. The bound of the errors is that of the farthest position in the world. It is 2^-50 of
 * the world's extent, far below the size of the smallest cell.
 */
#include "bounds.h"
#include "../exact/exact.h"
#include "../query/search.h"
#include "two_bodies.h"

static inline lanes reach_of_bodies(const axis_bounds *a, lanes steps)
{
    return lanes_add(lanes_multiply(steps, a->step), a->rest);
}

static inline lanes reach_of_halves(const axis_bounds *a, const cell_halves *h, int axis)
{
    return lanes_add(lanes_multiply(lanes_load(h->outer[axis]), a->unit), a->extra);
}

/* ---- Distances ---------------------------------------------------------------------------------------------- */

/* Three roundings of at most 2^-53 * (distance + reach) each are covered, and by the factor those of the squares. Far
 * outside the world squares might overflow. */
void prepare_squares(query_bounds *b, const level *l, const double target[3])
{
    const double scale = l->tree->scale;
    for (int i = 0; i < 3; i++) {
        const double way = find_farthest(l, i, target[i]), error = (way + l->reach[i]) * 0x1p-50;
        const half_steps half = half_steps_of(l, i);
        const bool moderate = way * scale < 0x1p500;
        b->axes[i] = (axis_bounds){.origin = lanes_all(target[i]),
                                   .factor = lanes_all(moderate ? scale * (1 - 0x1p-51) : 0),
                                   .step = lanes_all(half.step),
                                   .rest = lanes_all(moderate ? half.rest + error : HUGE_VAL),
                                   .unit = lanes_all(1),
                                   .extra = lanes_all(moderate ? error : HUGE_VAL),
                                   .min = lanes_all(target[i]),
                                   .max = lanes_all(target[i])};
    }
}

static inline lanes bound_gap(const axis_bounds *a, lanes center, lanes reach)
{
    const lanes offset = lanes_absolute(lanes_subtract(center, a->origin));
    return lanes_larger(lanes_multiply(lanes_subtract(offset, reach), a->factor), lanes_all(0));
}

/* The last term covers the underflow of squares. */
static inline lanes bound_two_squares(const query_bounds *b, const two_bodies *two)
{
    lanes sum = lanes_all(-0x1p-1000);
    for (int i = 0; i < 3; i++) {
        const lanes gap = bound_gap(&b->axes[i], two->position[i], reach_of_bodies(&b->axes[i], two->steps[i]));
        sum = lanes_add(sum, lanes_multiply(gap, gap));
    }
    return sum;
}

uint64_t bound_squares(const query_bounds *b, const octree_point *points, unsigned count, double cut, double *bounds)
{
    uint64_t far = 0;
    for (unsigned i = 0; i < count; i += 2) {
        const unsigned at = begin_of_pair(count, i);
        const two_bodies two = load_two_bodies(points, count, at);
        const lanes squares = bound_two_squares(b, &two);
        lanes_store(&bounds[at], squares);
        far |= (uint64_t)lanes_less(lanes_all(cut), squares) << at;
    }
    return ~far & UINT64_MAX >> (SCAN_POINTS - count);
}

/* The halves of the cell are bounded once. */
void bound_squares_of_octants(const query_bounds *b, const cell_halves *h, double bounds[8])
{
    double squares[2][2];
    lanes gap;
    for (int i = 0; i < 3; i++) {
        gap = bound_gap(&b->axes[i], lanes_load(h->center[i]), reach_of_halves(&b->axes[i], h, i));
        if (i < 2)
            lanes_store(squares[i], lanes_multiply(gap, gap));
    }
    const lanes z = lanes_subtract(lanes_multiply(gap, gap), lanes_all(0x1p-1000));
    for (unsigned o = 0; o < 8; o += 2)
        lanes_store(&bounds[o], lanes_add(lanes_all(squares[0][o >> 2] + squares[1][o >> 1 & 1]), z));
}

/* The differences have only relative errors, which the factor covers. */
unsigned bound_squares_of_boxes(const query_bounds *b, const sibling_boxes *boxes, double cut, double bounds[8])
{
    unsigned far = 0;
    for (unsigned i = 0; i < boxes->count; i += 2) {
        const unsigned at = begin_of_pair(boxes->count, i);
        const two_boxes two = load_two_boxes(boxes, at);
        lanes sum = lanes_all(-0x1p-1000);
        for (int k = 0; k < 3; k++) {
            const axis_bounds *a = &b->axes[k];
            const lanes outside = lanes_larger(lanes_subtract(two.min[k], a->max), lanes_subtract(a->min, two.max[k]));
            const lanes gap = lanes_larger(lanes_multiply(outside, a->factor), lanes_all(0));
            sum = lanes_add(sum, lanes_multiply(gap, gap));
        }
        lanes_store(&bounds[at], sum);
        far |= lanes_less(lanes_all(cut), sum) << at;
    }
    return ~far & mask_of_siblings(boxes);
}

/* ---- Times -------------------------------------------------------------------------------------------------- */

/* If nothing moves on an axis, a tiny speed serves: bodies on the way are touched at all times, and others so late that
 * they do not count. */
static double find_inverse_speed(const cast *c, int axis, double way)
{
    return c->sign[axis] ? c->inverse[axis] : 0x1p900 / way;
}

/* Some 8 roundings of at most 2^-53 * (distance + reach) / speed are covered, and the underflow of products. */
static axis_bounds prepare_axis_of_times(const level *l, const cast *c, int i)
{
    const double way = find_farthest(l, i, c->origin[i]) + l->reach[i] + c->half[i];
    const double inverse = find_inverse_speed(c, i, way), latest = way * inverse;
    const half_steps half = half_steps_of(l, i);
    const double extra = c->half[i] * inverse + latest * 0x1p-49 + 0x1p-1000;
    return (axis_bounds){.origin = lanes_all(c->origin[i]),
                         .factor = lanes_all(!(latest < 0x1p1000) ? NAN
                                             : c->sign[i] < 0     ? -inverse
                                                                  : inverse),
                         .step = lanes_all(half.step * inverse),
                         .rest = lanes_all(half.rest * inverse + extra),
                         .unit = lanes_all(inverse),
                         .extra = lanes_all(extra),
                         .min = lanes_all(exact_add_down(c->origin[i], -c->half[i])),
                         .max = lanes_all(exact_add_up(c->origin[i], c->half[i]))};
}

void prepare_times(query_bounds *b, const level *l, const cast *c)
{
    b->length = lanes_all(c->length < 0x1p1000 ? c->length : HUGE_VAL);
    for (int i = 0; i < 3; i++)
        b->axes[i] = prepare_axis_of_times(l, c, i);
}

/* The times at which two bodies are touched, on the axes that were examined so far. */
typedef struct two_spans {
    lanes enter, leave;
} two_spans;

/* A time that is NaN excludes nothing. */
static inline void narrow_spans(two_spans *known, const axis_bounds *a, lanes center, lanes reach)
{
    const lanes middle = lanes_multiply(lanes_subtract(center, a->origin), a->factor);
    known->enter = lanes_larger(lanes_subtract(middle, reach), known->enter);
    known->leave = lanes_smaller(lanes_add(middle, reach), known->leave);
}

uint64_t bound_times(const query_bounds *b, const octree_point *points, unsigned count, double cut, double *bounds)
{
    uint64_t far = 0;
    for (unsigned i = 0; i < count; i += 2) {
        const unsigned at = begin_of_pair(count, i);
        const two_bodies two = load_two_bodies(points, count, at);
        two_spans known = {lanes_all(0), b->length};
        for (int k = 0; k < 3; k++)
            narrow_spans(&known, &b->axes[k], two.position[k], reach_of_bodies(&b->axes[k], two.steps[k]));
        lanes_store(&bounds[at], known.enter);
        far |= (uint64_t)lanes_less(lanes_smaller(lanes_all(cut), known.leave), known.enter) << at;
    }
    return ~far & UINT64_MAX >> (SCAN_POINTS - count);
}

void bound_times_of_octants(const query_bounds *b, const cell_halves *h, double bounds[8])
{
    double enter[2][2], leave[2][2];
    two_spans halves;
    for (int i = 0; i < 3; i++) {
        halves = (two_spans){lanes_all(0), lanes_all(HUGE_VAL)};
        narrow_spans(&halves, &b->axes[i], lanes_load(h->center[i]), reach_of_halves(&b->axes[i], h, i));
        if (i < 2) {
            lanes_store(enter[i], halves.enter);
            lanes_store(leave[i], halves.leave);
        }
    }
    for (unsigned o = 0; o < 8; o += 2) {
        const unsigned x = o >> 2, y = o >> 1 & 1;
        const lanes begin = lanes_larger(lanes_all(larger(enter[0][x], enter[1][y])), halves.enter);
        const lanes end = lanes_smaller(lanes_all(-larger(-leave[0][x], -leave[1][y])), halves.leave);
        const lanes excess = lanes_subtract(begin, lanes_smaller(end, b->length));
        lanes_store(&bounds[o], lanes_larger(lanes_if_positive(excess, HUGE_VAL), begin));
    }
}

/* Intersect with the times at which the moving box touches two boxes on one axis. They have only relative errors. */
static inline void narrow_spans_of_boxes(two_spans *known, const axis_bounds *a, lanes min, lanes max)
{
    const lanes one = lanes_multiply(lanes_subtract(min, a->max), a->factor);
    const lanes other = lanes_multiply(lanes_subtract(max, a->min), a->factor);
    known->enter = lanes_larger(lanes_smaller(one, other), known->enter);
    known->leave = lanes_smaller(lanes_larger(one, other), known->leave);
}

/* Returns the spans with room for three roundings of a time on each side. */
static inline two_spans widen_spans(const two_spans *known)
{
    const lanes error =
        lanes_add(lanes_multiply(lanes_absolute(known->leave), lanes_all(0x1p-50)), lanes_all(0x1p-1000));
    const lanes enter = lanes_multiply(known->enter, lanes_all(1 - 0x1p-50));
    return (two_spans){lanes_subtract(enter, lanes_all(0x1p-1000)), lanes_add(known->leave, error)};
}

unsigned bound_times_of_boxes(const query_bounds *b, const sibling_boxes *boxes, double cut, double bounds[8])
{
    unsigned far = 0;
    for (unsigned i = 0; i < boxes->count; i += 2) {
        const unsigned at = begin_of_pair(boxes->count, i);
        const two_boxes two = load_two_boxes(boxes, at);
        two_spans known = {lanes_all(0), b->length};
        for (int k = 0; k < 3; k++)
            narrow_spans_of_boxes(&known, &b->axes[k], two.min[k], two.max[k]);
        const two_spans wide = widen_spans(&known);
        lanes_store(&bounds[at], wide.enter);
        far |= lanes_less(lanes_smaller(lanes_all(cut), wide.leave), wide.enter) << at;
    }
    return ~far & mask_of_siblings(boxes);
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

/* The box is cut to the extent of the level, so that all numbers are finite, but for those of a level without a reach.
 * Among subnormal numbers, the errors are those of halving. A body has at least the half extents in its id. */
void prepare_box_test(query_bounds *b, const level *l, const octree_box *box)
{
    b->unsure = lanes_all(-HUGE_VAL);
    for (int i = 0; i < 3; i++) {
        const axis *world = &l->tree->axes[i];
        const double min = larger(box->min[i], world->min - l->reach[i]);
        const double max = -larger(-box->max[i], -world->max - l->reach[i]);
        const double middle = min / 2 + max / 2, extent = max / 2 - min / 2, size = larger(fabs(min), fabs(max));
        const double error = (size + find_farthest(l, i, 0) + l->reach[i]) * 0x1p-50 + 0x1p-1072;
        const half_steps half = half_steps_of(l, i);
        b->axes[i] = (axis_bounds){.origin = lanes_all(middle),
                                   .step = lanes_all(half.step),
                                   .rest = lanes_all(half.rest + extent + error),
                                   .min = lanes_all(box->min[i]),
                                   .max = lanes_all(box->max[i]),
                                   .inner = lanes_all(extent - error)};
        if (!(fabs(middle) + fabs(extent) + error <= DBL_MAX))
            b->unsure = lanes_all(HUGE_VAL);
    }
}

body_masks test_box(const query_bounds *b, const octree_point *points, unsigned count)
{
    uint64_t apart = 0, sure = 0;
    for (unsigned i = 0; i < count; i += 2) {
        const unsigned at = begin_of_pair(count, i);
        const two_bodies two = load_two_bodies(points, count, at);
        lanes gap = lanes_all(0), excess = b->unsure;
        for (int k = 0; k < 3; k++) {
            const axis_bounds *a = &b->axes[k];
            const lanes offset = lanes_absolute(lanes_subtract(two.position[k], a->origin));
            const lanes way = lanes_subtract(offset, lanes_multiply(two.steps[k], a->step));
            gap = lanes_larger(lanes_subtract(way, a->rest), gap);
            excess = lanes_larger(lanes_subtract(way, a->inner), excess);
        }
        apart |= (uint64_t)lanes_less(lanes_all(0), gap) << at;
        sure |= (uint64_t)lanes_less(excess, lanes_all(0)) << at;
    }
    const uint64_t all = UINT64_MAX >> (SCAN_POINTS - count);
    return (body_masks){~apart & all, sure & all};
}

unsigned test_boxes(const query_bounds *b, const sibling_boxes *boxes)
{
    unsigned apart = 0;
    for (unsigned i = 0; i < boxes->count; i += 2) {
        const unsigned at = begin_of_pair(boxes->count, i);
        const two_boxes two = load_two_boxes(boxes, at);
        lanes gap = lanes_all(0);
        for (int k = 0; k < 3; k++) {
            gap = lanes_larger(lanes_subtract(two.min[k], b->axes[k].max), gap);
            gap = lanes_larger(lanes_subtract(b->axes[k].min, two.max[k]), gap);
        }
        apart |= lanes_less(lanes_all(0), gap) << at;
    }
    return ~apart & mask_of_siblings(boxes);
}
