/* SPDX-License-Identifier: MIT */
/* bounds.c - lower bounds of distances and times for boxes that contain bodies. */
#include "bounds.h"
#include "../query/search.h"

/* ---- Distances ---------------------------------------------------------------------------------------------- */

/* Returns lower bounds of the distances on one axis from a target to the intervals center +- half, multiplied by a
 * scale. Three roundings of at most 2^-53 * (offset + half) each are subtracted. If a value overflows, the bound is
 * 0. */
static inline lanes bound_gaps(double target, lanes center, lanes half, double scale)
{
    const lanes offset = lanes_absolute(lanes_subtract(lanes_all(target), center));
    const lanes error = lanes_multiply(lanes_add(offset, half), lanes_all(0x1p-50));
    const lanes gap = lanes_subtract(lanes_subtract(offset, half), error);
    return lanes_multiply(lanes_larger(gap, lanes_all(0)), lanes_all(scale));
}

/* Returns lower bounds of the sums of three squares. A sum near overflow is cut. */
static inline lanes bound_sums_of_squares(lanes x, lanes y, lanes z)
{
    const lanes xy = lanes_add(lanes_multiply(x, x), lanes_multiply(y, y));
    const lanes sum = lanes_add(xy, lanes_multiply(z, z));
    const lanes bound = lanes_subtract(lanes_multiply(sum, lanes_all(1 - 0x1p-50)), lanes_all(0x1p-1000));
    return lanes_larger(lanes_smaller(bound, lanes_all(0x1p1020)), lanes_all(0));
}

void bound_squares_of_octants(const double target[3], double scale, const cell_halves *h, double bounds[8])
{
    double gaps[2][2];
    for (int i = 0; i < 2; i++)
        lanes_store(gaps[i], bound_gaps(target[i], lanes_load(h->center[i]), lanes_load(h->outer[i]), scale));
    const lanes z = bound_gaps(target[2], lanes_load(h->center[2]), lanes_load(h->outer[2]), scale);
    for (unsigned o = 0; o < 8; o += 2)
        lanes_store(&bounds[o], bound_sums_of_squares(lanes_all(gaps[0][o >> 2]), lanes_all(gaps[1][o >> 1 & 1]), z));
}

static inline lanes bound_two_squares(const double target[3], double scale, const two_bodies *two)
{
    lanes gaps[3];
    for (int k = 0; k < 3; k++)
        gaps[k] = bound_gaps(target[k], two->center[k], two->most[k], scale);
    return bound_sums_of_squares(gaps[0], gaps[1], gaps[2]);
}

lanes bound_squares_of_two(const double target[3], double scale, const two_bodies *two)
{
    return bound_two_squares(target, scale, two);
}

/* Store two bounds at an even index. Returns the bits of the bounds that are at most `cut`. */
static inline uint64_t store_bounds(double *bounds, unsigned i, lanes two, lanes cut)
{
    lanes_store(&bounds[i], two);
    return (uint64_t)(3 & ~lanes_less(cut, two)) << i;
}

uint64_t bound_squares_of_bodies(const double target[3], double scale, const level *l, const octree_point *points,
                                 unsigned count, double cut, double *bounds)
{
    uint64_t near = 0;
    for (unsigned i = 0; i < count; i += 2) {
        const two_bodies two = load_two_bodies(l, &points[i], &points[i + 1 < count ? i + 1 : i]);
        near |= store_bounds(bounds, i, bound_two_squares(target, scale, &two), lanes_all(cut));
    }
    return near & UINT64_MAX >> (SCAN_POINTS - count);
}

/* ---- Times -------------------------------------------------------------------------------------------------- */

/* The intervals of time in which a moving box touches the bodies in two boxes, rounded outwards. */
typedef struct time_spans {
    lanes enter, leave;
} time_spans;

/* A lower bound of all times that overflow. HUGE_VAL means never. */
#define LATEST_TIME 0x1p1023

/* Covers the underflow of products. */
#define TIME_SLACK 0x1p-1000

cast_bounds make_cast_bounds(const cast *c)
{
    cast_bounds made;
    made.length = lanes_all(c->length < LATEST_TIME ? c->length : HUGE_VAL);
    for (int i = 0; i < 3; i++)
        made.axes[i] = (cast_axis){lanes_all(c->origin[i]),
                                   lanes_all(c->half[i]),
                                   lanes_all(c->sign[i]),
                                   lanes_all(c->inverse[i]),
                                   lanes_all(c->inverse[i] * 0x1p-49),
                                   c->sign[i] != 0};
    return made;
}

/* Returns the times at which a cast touches the intervals center +- half on one axis. On an axis without motion, this
 * is all time or none. The error is 16u * (distance + reach) / speed with u = 2^-53: some 8 roundings of a factor 1 +
 * u. It is computed as a time, because among subnormal numbers it would vanish as a distance. */
static inline time_spans find_spans(const cast_axis *c, lanes center, lanes half)
{
    const lanes offset = lanes_subtract(center, c->origin), reach = lanes_add(half, c->half);
    const lanes distance = lanes_absolute(offset), way = lanes_multiply(offset, c->sign);
    if (!c->moves) /* rounding is monotone, so the rounded terms are compared without an error */
        return (time_spans){lanes_if_positive(lanes_subtract(distance, reach), HUGE_VAL), lanes_all(HUGE_VAL)};
    const lanes error = lanes_multiply(lanes_add(distance, reach), c->slack);
    return (time_spans){lanes_subtract(lanes_multiply(lanes_subtract(way, reach), c->inverse), error),
                        lanes_add(lanes_multiply(lanes_add(way, reach), c->inverse), error)};
}

/* A time that is NaN excludes nothing. */
static inline void narrow_spans(time_spans *known, time_spans axis)
{
    known->enter = lanes_larger(axis.enter, known->enter);
    known->leave = lanes_smaller(axis.leave, known->leave);
}

/* Returns the begins of spans, or HUGE_VAL for a span that has no time. A begin that overflows is the latest time. */
static inline lanes begin_of_spans(time_spans spans)
{
    const lanes excess = lanes_subtract(lanes_subtract(spans.enter, spans.leave), lanes_all(2 * TIME_SLACK));
    const lanes begin = lanes_smaller(lanes_all(LATEST_TIME), lanes_subtract(spans.enter, lanes_all(TIME_SLACK)));
    return lanes_larger(lanes_if_positive(excess, HUGE_VAL), begin);
}

void bound_times_of_octants(const cast_bounds *c, const cell_halves *h, double bounds[8])
{
    double enter[2][2], leave[2][2];
    for (int i = 0; i < 2; i++) {
        time_spans halves = {lanes_all(0), c->length};
        narrow_spans(&halves, find_spans(&c->axes[i], lanes_load(h->center[i]), lanes_load(h->outer[i])));
        lanes_store(enter[i], halves.enter);
        lanes_store(leave[i], halves.leave);
    }
    const time_spans z = find_spans(&c->axes[2], lanes_load(h->center[2]), lanes_load(h->outer[2]));
    for (unsigned o = 0; o < 8; o += 2) {
        const unsigned x = o >> 2, y = o >> 1 & 1;
        time_spans octants = {lanes_all(larger(enter[0][x], enter[1][y])),
                              lanes_all(-larger(-leave[0][x], -leave[1][y]))};
        narrow_spans(&octants, z);
        lanes_store(&bounds[o], begin_of_spans(octants));
    }
}

static inline lanes bound_two_times(const cast_bounds *c, const two_bodies *two)
{
    time_spans known = {lanes_all(0), c->length};
    for (int k = 0; k < 3; k++)
        narrow_spans(&known, find_spans(&c->axes[k], two->center[k], two->most[k]));
    return begin_of_spans(known);
}

lanes bound_times_of_two(const cast_bounds *c, const two_bodies *two)
{
    return bound_two_times(c, two);
}

uint64_t bound_times_of_bodies(const cast_bounds *c, const level *l, const octree_point *points, unsigned count,
                               double cut, double *bounds)
{
    uint64_t near = 0;
    for (unsigned i = 0; i < count; i += 2) {
        const two_bodies two = load_two_bodies(l, &points[i], &points[i + 1 < count ? i + 1 : i]);
        near |= store_bounds(bounds, i, bound_two_times(c, &two), lanes_all(cut));
    }
    return near & UINT64_MAX >> (SCAN_POINTS - count);
}
