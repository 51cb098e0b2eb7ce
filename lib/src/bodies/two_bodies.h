/* SPDX-License-Identifier: MIT */
/* two_bodies.h - the positions of two bodies and bounds of their half extents, for tests of two bodies at once.
 * Private.
 *
 * The id of a body's point has the index of the body's row in its lower 32 bits. The upper bits have the half extents
 * in multiples of the level's `unit`, rounded down, 10 bits for each axis. So most tests of a leaf read no rows.
 */
#ifndef OCTREE_TWO_BODIES_H
#define OCTREE_TWO_BODIES_H

#include "../exact/lanes.h"
#include "set.h"

enum { STEP_BITS = 10, STEP_SHIFT = 32, MAX_STEPS = (1 << STEP_BITS) - 1 };

/* Returns the id of the point of a body in a level. */
static inline uint64_t make_point_id(const level *l, uint32_t row, const double half[3])
{
    uint64_t id = row;
    for (int i = 0; i < 3; i++) {
        const double steps = half[i] * l->units;
        id |= (steps < MAX_STEPS ? (uint64_t)steps : MAX_STEPS) << (STEP_SHIFT + STEP_BITS * i);
    }
    return id;
}

typedef struct two_bodies {
    lanes center[3];
    lanes most[3]; /* upper bounds of the half extents */
} two_bodies;

static inline two_bodies load_two_bodies(const level *l, const octree_point *a, const octree_point *b)
{
    two_bodies two;
    lanes_load_positions(two.center, a->position, b->position);
    for (unsigned i = 0; i < 3; i++) {
        const lanes steps = lanes_of_bits(a->id, b->id, STEP_SHIFT + STEP_BITS * i, MAX_STEPS);
        const lanes most = lanes_add(lanes_multiply(steps, lanes_all(l->unit)), lanes_all(l->rest));
        two.most[i] = lanes_smaller(most, lanes_all(l->reach[i]));
    }
    return two;
}

#endif
