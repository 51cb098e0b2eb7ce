/* SPDX-License-Identifier: MIT */
/* two_bodies.h - the positions of two bodies and bounds of their half extents, for tests of two bodies at once.
 * Private.
 *
 * The id of a body's point has the half extents in multiples of the level's `unit`, rounded down, 10 bits for each
 * axis. The bits above are the index of the body's row. So most tests of a leaf read no rows.
 */
#ifndef OCTREE_TWO_BODIES_H
#define OCTREE_TWO_BODIES_H

#include "../exact/lanes.h"
#include "set.h"

enum { STEP_BITS = 10, MAX_STEPS = (1 << STEP_BITS) - 1 };

/* Returns the id of the point of a body in a level. */
static inline uint64_t make_point_id(const level *l, uint32_t row, const double half[3])
{
    uint64_t id = (uint64_t)row << ROW_SHIFT;
    for (int i = 0; i < 3; i++) {
        const double steps = half[i] * l->inverse_unit;
        id |= (steps < MAX_STEPS ? (uint64_t)steps : MAX_STEPS) << STEP_BITS * i;
    }
    return id;
}

typedef struct two_bodies {
    lanes position[3];
    /* The bits of the ids that have the half extents, masked but not shifted: those of axis i are units times
     * 2^(10 i). */
    lanes steps[3];
} two_bodies;

/* Load the bodies of two points. Of `count` points, the pair that begins at an index is loaded; see begin_of_pair(). */
static inline two_bodies load_two_bodies(const octree_point *points, unsigned count, unsigned at)
{
    const octree_point *a = &points[at], *b = a + (count > 1);
    two_bodies two;
    const lane_bits ids = lanes_load_bits(&a->id, &b->id);
    lanes_load_positions(two.position, a->position, b->position);
    for (int i = 0; i < 3; i++)
        two.steps[i] = lanes_of_bits(ids, (uint64_t)MAX_STEPS << STEP_BITS * i);
    return two;
}

/* On an axis of a level, a half extent is at most two_bodies.steps * step + rest. The product is exact. */
typedef struct half_steps {
    double step, rest;
} half_steps;

static inline half_steps half_steps_of(const level *l, int axis)
{
    if (!(l->reach[axis] > l->rest))
        return (half_steps){0, l->reach[axis]};
    return (half_steps){l->unit / (double)(1 << STEP_BITS * axis), l->rest};
}

#endif
