/* SPDX-License-Identifier: MIT */
/* arguments.c - see arguments.h. */
#include "arguments.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "fixture.h"
#include "octree/sample.h"

uint64_t any_id(trial *t)
{
    return random_below(&t->random, t->ids);
}

static void copy(double to[3], const double from[3])
{
    memcpy(to, from, 3 * sizeof *to);
}

static const double *any_place(trial *t)
{
    if (t->model.count > 0 && below(t, 3) == 0)
        return t->model.points[below(t, t->model.count)].position;
    return t->scene.places[below(t, t->scene.count)];
}

static void any_inside(trial *t, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = random_between(&t->random, t->model.def.world.min[axis], t->model.def.world.max[axis]);
}

static void nudge(trial *t, double at[3])
{
    const size_t axis = below(t, 3);
    at[axis] = scene_nudge(at[axis], (int)below(t, 5) - 2);
}

/* Beyond a face by one double, or by a lot. */
static void leave_world(trial *t, double at[3])
{
    const size_t axis = below(t, 3);
    const octree_box *world = &t->model.def.world;
    const double outside[] = {next_down(world->min[axis]), next_up(world->max[axis]), -DBL_MAX, DBL_MAX};
    at[axis] = outside[below(t, 4)];
}

static void spoil(trial *t, double at[3])
{
    static const double bad[] = {NAN, INFINITY, -INFINITY};
    const size_t axis = below(t, 3);
    at[axis] = bad[below(t, 3)];
}

static void turn_zeros(double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        if (at[axis] == 0)
            at[axis] = -at[axis];
}

void any_position(trial *t, double at[3])
{
    const size_t kind = below(t, 32);
    copy(at, t->scene.places[below(t, t->scene.count)]);
    if (kind < 3)
        nudge(t, at);
    else if (kind < 5)
        any_inside(t, at);
    else if (kind == 5)
        leave_world(t, at);
    else if (kind == 6 && below(t, 4) == 0)
        spoil(t, at);
    else if (kind == 7)
        turn_zeros(at);
}

octree_point any_pair(trial *t)
{
    octree_point pair;
    const size_t kind = below(t, 16);
    if (t->model.count > 0 && kind > 1)
        pair = t->model.points[below(t, t->model.count)];
    else
        any_position(t, pair.position);
    if (t->model.count == 0 || kind < 3)
        pair.id = any_id(t);
    if (kind == 3)
        turn_zeros(pair.position);
    return pair;
}

static void far_away(trial *t, double at[3])
{
    static const double far[] = {1, 1e3, 1e9, 1e16, 1e155, 1e200, DBL_MAX};
    for (int axis = 0; axis < 3; axis++) {
        const double sign = (double)below(t, 3) - 1; /* 0: as it is */
        if (sign != 0)
            at[axis] = sign * far[below(t, 7)];
    }
}

void any_target(trial *t, double at[3])
{
    const size_t kind = below(t, 12);
    const double *a = any_place(t), *b = any_place(t);
    copy(at, kind == 0 ? t->scene.focus : a);
    if (kind == 1 || kind == 2)
        nudge(t, at);
    else if (kind < 6)
        any_inside(t, at);
    else if (kind < 8)
        for (int axis = 0; axis < 3; axis++) /* midway: a tie */
            at[axis] = a[axis] / 2 + b[axis] / 2;
    else if (kind == 8)
        for (int axis = 0; axis < 3; axis++) /* mirrored, often outside */
            at[axis] = scene_nudge(2 * (a[axis] - b[axis] / 2), 0);
    else if (kind == 9)
        far_away(t, at);
}

static double extent(const trial *t)
{
    double most = 0;
    for (int axis = 0; axis < 3; axis++)
        most = fmax(most, t->model.def.world.max[axis] / 2 - t->model.def.world.min[axis] / 2);
    return most; /* half of it: twice that may overflow */
}

static double beside(trial *t, double length)
{
    return fmin(fmax(scene_nudge(length, (int)below(t, 3) - 1), 0), DBL_MAX);
}

static double some_length(trial *t)
{
    const size_t kind = below(t, 16);
    const int halvings = (int)below(t, 6);
    const double length = kind == 1 ? DBL_MAX : ldexp(extent(t) * octree_random_unit(&t->random), -halvings);
    return kind == 0 ? 0 : fmin(length, DBL_MAX);
}

double any_radius(trial *t, const double center[3])
{
    if (below(t, 3) == 0)
        return some_length(t);
    const double *p = any_place(t);
    const long double x = (long double)p[0] - center[0], y = (long double)p[1] - center[1],
                      z = (long double)p[2] - center[2];
    return beside(t, (double)fminl(sqrtl(x * x + y * y + z * z), DBL_MAX));
}

double any_size(trial *t, const double center[3])
{
    const size_t axis = below(t, 3);
    return below(t, 3) == 0 ? some_length(t) : beside(t, fmin(fabs(any_place(t)[axis] - center[axis]), DBL_MAX));
}

double any_ratio(trial *t)
{
    static const double ratios[] = {0x1p-53, 0x1p-52, 0x1p-50, 1e-10, 0.01, 0.25, 1, 7, 1e6};
    return below(t, 2) == 0 ? 0 : ratios[below(t, sizeof ratios / sizeof ratios[0])];
}

double any_slack(trial *t, const double center[3])
{
    return below(t, 2) == 0 ? 0 : any_size(t, center);
}

static octree_box box_around(trial *t)
{
    octree_box box;
    double a[3], b[3];
    any_target(t, a);
    any_target(t, b);
    for (int axis = 0; axis < 3; axis++) {
        box.min[axis] = fmin(a[axis], b[axis]);
        box.max[axis] = fmax(a[axis], b[axis]);
    }
    return box;
}

static octree_box box_of_cell(trial *t)
{
    octree_address address = OCTREE_ROOT;
    for (size_t depth = below(t, 9); depth > 0; depth--)
        address = address << 3 | below(t, 8);
    return octree_cell_box(&t->model.def.world, address);
}

static octree_box box_about_target(trial *t)
{
    octree_box box;
    double at[3];
    any_target(t, at);
    for (int axis = 0; axis < 3; axis++) {
        const double size = below(t, 4) == 0 ? 0 : any_size(t, at);
        box.min[axis] = fmax(at[axis] - size, -DBL_MAX);
        box.max[axis] = fmin(at[axis] + size, DBL_MAX);
    }
    return box;
}

octree_box any_box(trial *t)
{
    const size_t kind = below(t, 8);
    octree_box box = kind == 0  ? t->model.def.world
                     : kind < 3 ? box_of_cell(t)
                     : kind < 5 ? box_around(t)
                                : box_about_target(t);
    if (below(t, 3) == 0) {
        const size_t axis = below(t, 3);
        const double low = scene_nudge(box.min[axis], (int)below(t, 5) - 2);
        const double high = scene_nudge(box.max[axis], (int)below(t, 5) - 2);
        box.min[axis] = fmin(low, high);
        box.max[axis] = fmax(low, high);
    }
    if (below(t, 16) == 0)
        box.min[below(t, 3)] = -INFINITY;
    if (below(t, 16) == 0)
        box.max[below(t, 3)] = INFINITY;
    return box;
}

octree_search any_search(trial *t)
{
    octree_search how = {.skip = (octree_skip)below(t, 3)};
    how.mode = below(t, 4) == 0 ? OCTREE_FAST : OCTREE_EXACT;
    how.skip_id = t->model.count > 0 ? t->model.points[below(t, t->model.count)].id : any_id(t);
    how.cost = below(t, 4) == 0 ? &t->cost : NULL;
    return how;
}
