/* SPDX-License-Identifier: MIT */
/* few_bodies.h - the positions of as many bodies as there are lanes, and bounds of their half extents. Private.
 *
 * The id of a body's point has the half extents in multiples of the level's `unit`, rounded down, 10 bits for each
 * axis. The bits above are the index of the body's row. So most tests of a leaf read no rows.
 */
#ifndef OCTREE_FEW_BODIES_H
#define OCTREE_FEW_BODIES_H

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

/* Returns the point of a body in a level. */
static inline octree_point make_point(const level *l, uint32_t row, const octree_body *body)
{
    return (octree_point){{body->position[0], body->position[1], body->position[2]}, make_point_id(l, row, body->half)};
}

typedef struct few_bodies {
    lanes position[3];
    /* The bits of the ids that have the half extents, masked but not shifted: those of axis i are units times
     * 2^(10 i). */
    lanes steps[3];
} few_bodies;

/* Load the bodies of a group of points, which begins at an index; see begin_of_group(). */
static inline few_bodies load_few_bodies(const octree_point *points, unsigned count, unsigned begin)
{
    const octree_point *group[LANES];
    few_bodies few;
    lane_bits ids;
    for (unsigned i = 0; i < LANES; i++)
        group[i] = &points[lane_index(count, begin, i)];
    lanes_load_points(few.position, &ids, group);
    for (int i = 0; i < 3; i++)
        few.steps[i] = lanes_of_bits(ids, (uint64_t)MAX_STEPS << STEP_BITS * i);
    return few;
}

/* Returns the factor that turns few_bodies.steps of an axis into half extents. The product is exact. */
static inline double step_of_half_extents(const level *l, int axis)
{
    return l->unit / (double)(1 << STEP_BITS * axis);
}

/* On an axis of a level, a half extent is at most few_bodies.steps * step + rest. */
typedef struct half_steps {
    double step, rest;
} half_steps;

static inline half_steps half_steps_of(const level *l, int axis)
{
    if (!(l->reach[axis] > l->rest))
        return (half_steps){0, l->reach[axis]};
    return (half_steps){step_of_half_extents(l, axis), l->rest};
}

#endif
