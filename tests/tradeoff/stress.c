/* SPDX-License-Identifier: MIT */
/* stress.c - see stress.h. */
#include "stress.h"

#include "fixture.h"

#include <math.h>
#include <string.h>

const stress stresses[] = {
    {"ordinary", "coordinates up to 1000", STRESS_CUBE, 0, 1000, 0, APART_PLAIN, false},
    {"extent 1e-310", "subnormal coordinates", STRESS_CUBE, 0, 1e-310, 0, APART_PLAIN, false},
    {"extent 1e-300", "squares of coordinates vanish", STRESS_CUBE, 0, 1e-300, 0, APART_PLAIN, false},
    {"extent 1e-30", "squares of coordinates vanish in floats", STRESS_CUBE, 0, 1e-30, 0, APART_PLAIN, false},
    {"extent 1e30", "squares of coordinates overflow in floats", STRESS_CUBE, 0, 1e30, 0, APART_PLAIN, false},
    {"extent 1e300", "squares of coordinates overflow", STRESS_CUBE, 0, 1e300, 0, APART_PLAIN, false},
    {"offset 1e3", "millimetres, 1 km from the origin", STRESS_GRAINS, 1e3, 1, 1e-3, APART_PLAIN, false},
    {"offset 1e6", "millimetres, 1000 km from the origin", STRESS_GRAINS, 1e6, 1, 1e-3, APART_PLAIN, false},
    {"offset 1e9", "millimetres, 1e9 m from the origin", STRESS_GRAINS, 1e9, 1, 1e-3, APART_PLAIN, false},
    {"offset 1e12", "millimetres, 1e12 m from the origin", STRESS_GRAINS, 1e12, 1, 1e-3, APART_PLAIN, false},
    {"near ties", "a grid of 0.1, which doubles round", STRESS_TENTHS, 0, 0.7, 0.1, APART_PLAIN, false},
    {"boundaries", "whole numbers; regions end exactly at points", STRESS_WHOLE, 0, 3, 1, APART_PLAIN, false},
    {"coincident", "three places for all points", STRESS_FEW, 0, 1, 0, APART_PLAIN, false},
    {"no points", "an index of nothing", STRESS_EMPTY, 0, 1, 0, APART_PLAIN, false},
    {"NaN", "one coordinate is not a number", STRESS_NAN, 0, 1000, 0, APART_PLAIN, false},
    {"infinity", "one coordinate is infinite", STRESS_INFINITY, 0, 1000, 0, APART_PLAIN, false},
    {"flush to zero", "subnormal coordinates; the processor flushes them to zero", STRESS_CUBE, 0, 1e-310, 0,
     APART_PLAIN, true},
    {"-ffast-math", "near ties; the index is compiled with -ffast-math", STRESS_TENTHS, 0, 0.7, 0.1, APART_FAST, false},
    {"-ffast-math and NaN", "one coordinate is not a number", STRESS_NAN, 0, 1000, 0, APART_FAST, false},
    {"fused multiply-add", "near ties; the index is compiled with -ffp-contract=fast", STRESS_TENTHS, 0, 0.7, 0.1,
     APART_CONTRACTED, false},
};
const size_t stress_count = sizeof stresses / sizeof stresses[0];

/* A position among those of the points. */
static void place(const stress *s, uint64_t *random, double at[3])
{
    uint64_t where = 5 + random_below(random, 3);
    uint64_t *const from = s->kind == STRESS_FEW ? &where : random;
    for (int i = 0; i < 3; i++) {
        if (s->kind == STRESS_WHOLE || s->kind == STRESS_TENTHS)
            at[i] = (double)random_below(random, 8) * s->grain;
        else
            at[i] = random_between(from, -s->extent, s->extent);
        if (s->kind == STRESS_GRAINS)
            at[i] = s->offset + floor(at[i] / s->grain) * s->grain;
    }
}

/* Halfway between grid positions for near ties, on them for boundaries, anywhere for the others. */
static void aim(const stress *s, uint64_t *random, double at[3])
{
    place(s, random, at);
    for (int i = 0; i < 3; i++)
        if (s->kind == STRESS_TENTHS)
            at[i] = ((double)random_below(random, 7) + 0.5) * s->grain;
        else if (s->kind == STRESS_FEW)
            at[i] = random_between(random, -s->extent, s->extent);
}

/* Regions of about a tenth of the points. Those of STRESS_WHOLE and STRESS_TENTHS end at points. */
static octree_query make_query(const stress *s, uint64_t *random, octree_query_kind kind)
{
    octree_query query = {.kind = kind, .k = 8};
    aim(s, random, query.target);
    query.radius = s->kind == STRESS_WHOLE ? 1 + (double)random_below(random, 3)
                   : s->kind == STRESS_TENTHS
                       ? hypot(hypot(0.05, 0.05), 0.05) * (1 + 2 * (double)random_below(random, 2))
                       : s->extent * random_between(random, 0.3, 0.7);
    for (int i = 0; i < 3; i++) {
        query.box.min[i] = query.target[i] - query.radius;
        query.box.max[i] = query.target[i] + query.radius;
    }
    return query;
}

void stress_make(const stress *s, octree_query_kind kind, stress_set *set)
{
    uint64_t random = 11;
    memset(set, 0, sizeof *set);
    set->count = s->kind == STRESS_EMPTY ? 0 : STRESS_POINTS;
    set->finite = s->kind != STRESS_NAN && s->kind != STRESS_INFINITY;
    for (size_t i = 0; i < set->count; i++) {
        set->points[i].id = i;
        place(s, &random, set->points[i].position);
    }
    for (int i = 0; i < 3; i++) {
        set->world.min[i] = s->kind == STRESS_TENTHS || s->kind == STRESS_WHOLE ? 0 : s->offset - s->extent - s->grain;
        set->world.max[i] = s->kind == STRESS_TENTHS || s->kind == STRESS_WHOLE ? 8 * s->grain : s->offset + s->extent;
    }
    if (!set->finite)
        set->points[set->count / 2].position[1] = s->kind == STRESS_NAN ? NAN : INFINITY;
    for (size_t i = 0; i < STRESS_QUERIES; i++)
        set->queries[i] = make_query(s, &random, kind);
}
