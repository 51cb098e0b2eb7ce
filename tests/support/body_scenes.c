/* SPDX-License-Identifier: MIT */
/* body_scenes.c - random bodies and regions for tests, at every scale of doubles. */
#include "body_scenes.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "fixture.h"

octree_box scene_world(scene_numbers numbers)
{
    switch (numbers) {
    case NUMBERS_FAR:
        return cube(1e15, 1e15 + 64);
    case NUMBERS_TINY:
        return cube(0, 0x1p-1060);
    case NUMBERS_HUGE:
    case NUMBERS_EXTREME:
        return cube(-DBL_MAX, DBL_MAX);
    default:
        return cube(-8, 8);
    }
}

static double random_coordinate(scene_numbers numbers, uint64_t *seed)
{
    switch (numbers) {
    case NUMBERS_LATTICE:
        return (double)random_below(seed, 33) / 2 - 8;
    case NUMBERS_FAR:
        return 1e15 + (double)random_below(seed, 513) / 8;
    case NUMBERS_TINY:
        return (double)random_below(seed, 16385) * 0x1p-1074;
    case NUMBERS_HUGE:
        return random_between(seed, -DBL_MAX, DBL_MAX);
    case NUMBERS_EXTREME:
        return random_extreme(seed);
    default:
        return random_between(seed, -8, 8);
    }
}

/* A length whose size is somewhere between the world's and a small part of it. */
static double random_length(scene_numbers numbers, uint64_t *seed)
{
    const int shift = (int)random_below(seed, 7);
    if (random_below(seed, 5) == 0)
        return 0;
    switch (numbers) {
    case NUMBERS_LATTICE:
        return (double)random_below(seed, (uint64_t)(32 >> shift) + 1) / 2;
    case NUMBERS_FAR:
        return (double)random_below(seed, (uint64_t)(512 >> shift) + 1) / 8;
    case NUMBERS_TINY:
        return (double)random_below(seed, (uint64_t)(16384 >> shift) + 1) * 0x1p-1074;
    case NUMBERS_HUGE:
        return ldexp(random_between(seed, 0, DBL_MAX), -2 * shift);
    case NUMBERS_EXTREME:
        return fabs(random_extreme(seed));
    default:
        return ldexp(random_between(seed, 0, 8), -2 * shift);
    }
}

void random_target(scene_numbers numbers, uint64_t *seed, double target[3])
{
    for (int i = 0; i < 3; i++)
        target[i] = random_coordinate(numbers, seed);
    if (random_below(seed, 8) == 0 && numbers < NUMBERS_HUGE)
        target[random_below(seed, 3)] *= 3;
}

static void random_halves(scene_numbers numbers, uint64_t *seed, double half[3])
{
    const bool cubic = random_below(seed, 2);
    for (int i = 0; i < 3; i++)
        half[i] = i > 0 && cubic ? half[0] : random_length(numbers, seed);
}

octree_body random_body(scene_numbers numbers, uint64_t *seed, uint64_t id)
{
    octree_body body = {.id = id};
    for (int i = 0; i < 3; i++)
        body.position[i] = random_coordinate(numbers, seed);
    random_halves(numbers, seed, body.half);
    return body;
}

static void random_box(scene_numbers numbers, uint64_t *seed, octree_box *box)
{
    for (int i = 0; i < 3; i++) {
        const double a = random_coordinate(numbers, seed), b = random_coordinate(numbers, seed);
        box->min[i] = a < b ? a : b;
        box->max[i] = a < b ? b : a;
        if (random_below(seed, 16) == 0)
            box->max[i] = HUGE_VAL;
        if (random_below(seed, 16) == 0)
            box->min[i] = -HUGE_VAL;
    }
}

static void random_direction(scene_numbers numbers, uint64_t *seed, double direction[3])
{
    do
        for (int i = 0; i < 3; i++)
            direction[i] = numbers == NUMBERS_EXTREME  ? random_extreme(seed)
                           : numbers == NUMBERS_SMOOTH ? random_between(seed, -1, 1)
                                                       : (double)random_below(seed, 5) - 2;
    while (direction[0] == 0 && direction[1] == 0 && direction[2] == 0);
}

static size_t random_half_spaces(scene_numbers numbers, uint64_t *seed, octree_half_space *half_spaces)
{
    const size_t count = 1 + random_below(seed, 6);
    for (size_t i = 0; i < count; i++) {
        double through[3];
        random_direction(numbers, seed, half_spaces[i].normal);
        random_target(numbers, seed, through);
        half_spaces[i].offset = 0;
        for (int k = 0; k < 3; k++)
            half_spaces[i].offset += half_spaces[i].normal[k] * through[k];
        if (!isfinite(half_spaces[i].offset))
            half_spaces[i].offset = random_coordinate(numbers, seed);
    }
    return count;
}

octree_region random_region(scene_numbers numbers, octree_region_kind kind, uint64_t *seed,
                            octree_half_space *half_spaces)
{
    octree_region r = {.kind = kind, .contained = random_below(seed, 3) == 0, .half_spaces = half_spaces};
    random_box(numbers, seed, &r.box);
    random_target(numbers, seed, r.center);
    r.radius = random_length(numbers, seed);
    r.half_space_count = random_half_spaces(numbers, seed, half_spaces);
    random_target(numbers, seed, r.from);
    random_target(numbers, seed, r.to);
    random_target(numbers, seed, r.origin);
    random_direction(numbers, seed, r.direction);
    if (numbers == NUMBERS_TINY)
        for (int i = 0; i < 3; i++)
            r.direction[i] *= random_below(seed, 2) ? 1 : 0x1p-1066;
    r.length = random_below(seed, 2) ? HUGE_VAL : (double)random_below(seed, 9);
    random_halves(numbers, seed, r.half);
    for (int i = 0; i < 3 && random_below(seed, 2); i++)
        r.half[i] = 0;
    return r;
}

bool add_pair_to_order(const octree_body *a, const octree_body *b, void *order)
{
    uint64_t *sum = order;
    *sum = *sum * 31 + a->id * 3 + b->id;
    return true;
}
