/* SPDX-License-Identifier: MIT */
/* point_sets.c - see point_sets.h. */
#include "point_sets.h"
#include "fixture.h"

#include <math.h>
#include <string.h>

static void place_within(uint64_t *random, double at[3], double low, double high)
{
    for (int i = 0; i < 3; i++)
        at[i] = random_between(random, low, high);
}

static void place_anywhere(uint64_t *random, double at[3])
{
    place_within(random, at, -1000, 1000);
}

/* Whole numbers: many equal distances, points on bounds, and points in one place. */
static void place_on_lattice(uint64_t *random, double at[3])
{
    for (int i = 0; i < 3; i++)
        at[i] = (double)random_below(random, 7);
}

/* Few places for many points. */
static void place_on_others(uint64_t *random, double at[3])
{
    uint64_t where = 77 + random_below(random, 20);
    place_within(&where, at, -1, 1);
}

/* Eastings and northings in metres, to the millimetre. */
static void place_in_survey(uint64_t *random, double at[3])
{
    const double from[3] = {500000, 5000000, 100};
    for (int i = 0; i < 3; i++)
        at[i] = from[i] + (double)random_below(random, 40000) / 1000;
}

/* Nearer to each other than floats are there. */
static void place_close(uint64_t *random, double at[3])
{
    place_within(random, at, 1000, 1000 + 0x1p-10);
}

static void place_tiny(uint64_t *random, double at[3])
{
    place_within(random, at, -1e-300, 1e-300);
}

static void place_huge(uint64_t *random, double at[3])
{
    place_within(random, at, -1e300, 1e300);
}

const point_set point_sets[POINT_SETS] = {
    {"uniform",
     "anywhere in a cube",
     true,
     200,
     POINT_SET_MOST,
     {{-1000, -1000, -1000}, {1000, 1000, 1000}},
     place_anywhere},
    {"lattice",
     "whole numbers: ties and points on bounds",
     true,
     200,
     POINT_SET_MOST,
     {{0, 0, 0}, {6, 6, 6}},
     place_on_lattice},
    {"equal", "twenty places for all points", true, 100, 200, {{-1, -1, -1}, {1, 1, 1}}, place_on_others},
    {"survey",
     "UTM coordinates, to the millimetre",
     true,
     200,
     POINT_SET_MOST,
     {{500000, 5000000, 100}, {500040, 5000040, 140}},
     place_in_survey},
    {"close",
     "nearer than the steps of floats",
     true,
     200,
     POINT_SET_MOST,
     {{1000, 1000, 1000}, {1001, 1001, 1001}},
     place_close},
    {"few", "one to nine points", true, 1, 9, {{-1000, -1000, -1000}, {1000, 1000, 1000}}, place_anywhere},
    {"tiny",
     "of an extent of 1e-300",
     false,
     100,
     200,
     {{-1e-300, -1e-300, -1e-300}, {1e-300, 1e-300, 1e-300}},
     place_tiny},
    {"huge", "of an extent of 1e300", false, 100, 200, {{-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}}, place_huge},
};

size_t point_set_fill(const point_set *set, uint64_t *random, octree_point *points)
{
    const size_t count = set->least + (size_t)random_below(random, set->most - set->least + 1);
    for (size_t i = 0; i < count; i++) {
        points[i].id = i;
        set->place(random, points[i].position);
    }
    return count;
}

static const double *any_of(uint64_t *random, const octree_point *points, size_t count)
{
    return points[random_below(random, count)].position;
}

/* A point's place, the middle of two, or another. */
static void aim(const point_set *set, uint64_t *random, const octree_point *points, size_t count, double at[3])
{
    const double *a = any_of(random, points, count), *b = any_of(random, points, count);
    const uint64_t way = random_below(random, 3);
    if (way == 0)
        set->place(random, at);
    else
        for (int i = 0; i < 3; i++)
            at[i] = way == 1 ? a[i] : a[i] / 2 + b[i] / 2;
}

/* Empty, ending at a point, or of any size. */
static double reach(uint64_t *random, const octree_point *points, size_t count, const double target[3])
{
    const double *a = any_of(random, points, count);
    const double x = fabs(a[0] - target[0]), y = fabs(a[1] - target[1]), z = fabs(a[2] - target[2]);
    const double most = fmax(x, fmax(y, z));
    const uint64_t way = random_below(random, 8);
    if (way == 0 || most == 0)
        return 0;
    if (way == 1)
        return most;
    const double distance = most * sqrt(x / most * (x / most) + y / most * (y / most) + z / most * (z / most));
    return way < 6 ? distance : distance * random_between(random, 0, 1);
}

octree_query point_set_ask(const point_set *set, uint64_t *random, octree_query_kind kind, const octree_point *points,
                           size_t count)
{
    static const size_t ks[] = {1, 2, 3, 8, 16};
    octree_query q = {.kind = kind, .k = ks[random_below(random, 5)]};
    double other[3];
    aim(set, random, points, count, q.target);
    aim(set, random, points, count, other);
    q.k = random_below(random, 20) == 0 ? count + random_below(random, 3) : q.k;
    q.radius = reach(random, points, count, q.target);
    for (int i = 0; i < 3; i++) {
        q.box.min[i] = fmin(q.target[i], other[i]);
        q.box.max[i] = fmax(q.target[i], other[i]);
    }
    return q;
}
