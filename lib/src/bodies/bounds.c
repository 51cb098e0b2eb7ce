/* SPDX-License-Identifier: MIT */
/* bounds.c - lower bounds of distances and times for the bodies of a leaf and the boxes of nodes.
 *
 * Everything that is the same for all bodies of a level is folded into two numbers an axis: a body's half extent, with
 * the extent of the query and a bound of all rounding errors, is at most steps * step + rest. The bound of the errors
 * is that of the farthest position in the world. It is 2^-50 of the world's extent, far below the size of the smallest
 * cell. The bodies themselves are computed in lane_bounds.h.
 */
#include "../exact/exact.h"
#include "lane_bounds.h"

const bound_functions bounds_in_two_lanes = {BOUND_FUNCTIONS};

static const bound_functions *choose_functions(void)
{
#ifdef OCTREE_AVX2
    if (__builtin_cpu_supports("avx2"))
        return &bounds_in_four_lanes;
#endif
    return &bounds_in_two_lanes;
}

/* ---- Distances ---------------------------------------------------------------------------------------------- */

/* Three roundings of at most 2^-53 * (distance + reach) each are covered, and by the factor those of the squares. Far
 * outside the world squares might overflow. */
void prepare_squares(query_bounds *b, const level *l, const double target[3])
{
    const double scale = l->tree->scale;
    b->in_lanes = choose_functions();
    for (int i = 0; i < 3; i++) {
        const double way = find_farthest(l, i, target[i]), error = (way + l->reach[i]) * 0x1p-50;
        const half_steps half = half_steps_of(l, i);
        const bool moderate = way * scale < 0x1p500;
        b->axes[i] = (axis_bounds){.origin = target[i],
                                   .factor = moderate ? scale * (1 - 0x1p-51) : 0,
                                   .step = half.step,
                                   .rest = moderate ? half.rest + error : HUGE_VAL,
                                   .min = target[i],
                                   .max = target[i]};
    }
}

/* ---- Times -------------------------------------------------------------------------------------------------- */

/* If nothing moves on an axis, a tiny speed serves: bodies on the way are touched at all times, and others so late that
 * they do not count. */
static double find_inverse_speed(const cast *c, int axis, double way)
{
    return c->sign[axis] ? c->inverse[axis] : 0x1p900 / way;
}

/* Some 8 roundings of at most 2^-53 * (distance + reach) / speed are covered, and the underflow of products. If nothing
 * moves on the axis, a box that only touches the way must not be left at the time 0: so the way is made wider there. */
static void prepare_axis_of_times(axis_bounds *axis, const level *l, const cast *c, int i)
{
    const double way = find_farthest(l, i, c->origin[i]) + l->reach[i] + c->half[i];
    const double inverse = find_inverse_speed(c, i, way), latest = way * inverse;
    const double extent = c->half[i] + (c->sign[i] ? 0 : way * 0x1p-50 + 0x1p-1070);
    const half_steps half = half_steps_of(l, i);
    *axis = (axis_bounds){.origin = c->origin[i],
                          .factor = !(latest < 0x1p1000) ? NAN
                                    : c->sign[i] < 0     ? -inverse
                                                         : inverse,
                          .step = half.step * inverse,
                          .rest = (half.rest + c->half[i]) * inverse + latest * 0x1p-49 + 0x1p-1000,
                          .min = extent > 0 ? exact_add_down(c->origin[i], -extent) : c->origin[i],
                          .max = extent > 0 ? exact_add_up(c->origin[i], extent) : c->origin[i]};
}

void prepare_times(query_bounds *b, const level *l, const cast *c)
{
    b->in_lanes = choose_functions();
    b->length = c->length < 0x1p1000 ? c->length : HUGE_VAL;
    for (int i = 0; i < 3; i++)
        prepare_axis_of_times(&b->axes[i], l, c, i);
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

/* The box is cut to the extent of the level, so that all numbers are finite, but for those of a level without a reach.
 * Among subnormal numbers, the errors are those of halving. A body has at least the half extents in its id. */
void prepare_box_test(query_bounds *b, const level *l, const octree_box *box)
{
    b->in_lanes = choose_functions();
    b->unsure = -HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        const axis *world = &l->tree->axes[i];
        const double min = larger(box->min[i], world->min - l->reach[i]);
        const double max = -larger(-box->max[i], -world->max - l->reach[i]);
        const double middle = min / 2 + max / 2, extent = max / 2 - min / 2, size = larger(fabs(min), fabs(max));
        const double error = (size + find_farthest(l, i, 0) + l->reach[i]) * 0x1p-50 + 0x1p-1072;
        const half_steps half = half_steps_of(l, i);
        b->axes[i] = (axis_bounds){.origin = middle,
                                   .step = half.step,
                                   .rest = half.rest + extent + error,
                                   .min = box->min[i],
                                   .max = box->max[i],
                                   .inner = extent - error};
        if (!(fabs(middle) + fabs(extent) + error <= DBL_MAX))
            b->unsure = HUGE_VAL;
    }
}
