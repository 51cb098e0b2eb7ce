/* collide_swept.c - what a box touches on its way from one place to another.
 *
 * On each axis the box covers a point's coordinate for an interval of the time t in 0..1: from enter = (p - f - r) / d
 * to leave = (p - f + r) / d, for a step d from f upwards, and the other way round downwards. The point is touched when
 * the three intervals and 0..1 have a moment in common: when every enter is at most every leave. Fractions are compared
 * by their cross products, in doubles where their error allows, else exactly.
 */
#include "exact.h"
#include "search.h"

#include <math.h>

typedef struct sweep {
    const double *from, *to;
    double size;
    const octree_point *self;
    octree_point_visitor visit;
    void *context;
} sweep;

static double direction(const sweep *s, int axis)
{
    return s->to[axis] < s->from[axis] ? -1 : 1;
}

/* Add way * (p - f - side * way * r) of one axis times the way's length on another. */
static void add_cross(exact_sum *sum, const sweep *s, const double p[3], int axis, int other, double side, int factor)
{
    const double way = direction(s, axis), other_way = direction(s, other);
    const double terms[3] = {way * p[axis], -way * s->from[axis], side * s->size};
    for (int i = 0; i < 3; i++) {
        exact_add_product(sum, factor, terms[i], other_way * s->to[other]);
        exact_add_product(sum, -factor, terms[i], other_way * s->from[other]);
    }
}

/* Is the box on the point's coordinate on axis `a` before it has left it on axis `b`? */
static bool enters_before(const sweep *s, const double p[3], int a, int b)
{
    exact_sum sum; /* leave_b - enter_a, times both lengths */
    exact_clear(&sum);
    add_cross(&sum, s, p, b, a, 1, 1);
    add_cross(&sum, s, p, a, b, -1, -1);
    return exact_sign(&sum) >= 0;
}

/* 1 or 0 when doubles can tell, -1 when only exact arithmetic can. Each bound takes in the roundings of its differences
 * and its division, with u = 2^-53: 32u of the sum of magnitudes, divided by the length. Where a step of that reckoning
 * overflows, the bound is infinite. */
static int guess(const sweep *s, const double p[3])
{
    double enter = 0, leave = 1, error = 0;
    for (int i = 0; i < 3; i++) {
        const double way = direction(s, i), length = way * (s->to[i] - s->from[i]);
        if (length == 0)
            continue; /* the box around the step has told */
        const double offset = way * (p[i] - s->from[i]);
        const double magnitude = fabs(p[i]) + fabs(s->from[i]) + fabs(s->to[i]) + s->size;
        enter = fmax(enter, (offset - s->size) / length);
        leave = fmin(leave, (offset + s->size) / length);
        error = isfinite(magnitude) && isfinite(length) ? fmax(error, magnitude / length * 0x1p-48) : INFINITY;
        error = fmax(error, (fabs(enter) + fabs(leave)) * 0x1p-48);
        if (!(error < 1))
            return -1;
    }
    return leave - enter > 2 * error ? 1 : enter - leave > 2 * error ? 0 : -1;
}

static bool touches(const sweep *s, const double p[3])
{
    const int guessed = guess(s, p);
    if (guessed >= 0)
        return guessed == 1;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            if (a != b && s->from[a] != s->to[a] && s->from[b] != s->to[b] && !enters_before(s, p, a, b))
                return false;
    return true;
}

static bool visit_touched(const octree_point *point, void *context)
{
    const sweep *s = context;
    return is_self(s->self, point) || !touches(s, point->position) || s->visit(point, s->context);
}

octree_status octree_collide_swept(const octree *tree, const double from[3], const double to[3], double box_size,
                                   const octree_point *self, octree_point_visitor visit, void *context)
{
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    octree_box start, end;
    octree_status status = octree_collision_box(from, box_size, &start);
    if (status == OCTREE_OK)
        status = octree_collision_box(to, box_size, &end);
    if (status != OCTREE_OK)
        return status;
    for (int i = 0; i < 3; i++) { /* around the whole step */
        start.min[i] = fmin(start.min[i], end.min[i]);
        start.max[i] = fmax(start.max[i], end.max[i]);
    }
    return octree_range(tree, &start, visit_touched, &(sweep){from, to, box_size, self, visit, context});
}
