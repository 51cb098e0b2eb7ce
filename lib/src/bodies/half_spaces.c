/* SPDX-License-Identifier: MIT */
/* half_spaces.c - excludes bodies of a leaf that are certainly outside a half-space: in doubles, two bodies at once.
 *
 * The exact test of a body reads its row, which often is a cache miss. The filter reads only the points of the leaf,
 * which have the positions and upper bounds of the half extents (two_bodies.h). Every sum has a bound of its error. A
 * value that overflows excludes nothing.
 */
#include "shape.h"
#include "../query/search.h"
#include "two_bodies.h"

/* The points of a leaf, and the box around their positions. */
typedef struct leaf_pairs {
    two_bodies pairs[SCAN_POINTS / 2];
    unsigned count; /* of points */
    double low[3], high[3];
} leaf_pairs;

static void load_pairs(leaf_pairs *leaf, const octree_point *points, unsigned count)
{
    lanes low[3], high[3];
    leaf->count = count;
    for (int k = 0; k < 3; k++) {
        low[k] = lanes_all(HUGE_VAL);
        high[k] = lanes_all(-HUGE_VAL);
    }
    for (unsigned i = 0; i < count; i += 2) {
        two_bodies *two = &leaf->pairs[i / 2];
        *two = load_two_bodies(points, count, begin_of_pair(count, i));
        for (int k = 0; k < 3; k++) {
            low[k] = lanes_smaller(two->position[k], low[k]);
            high[k] = lanes_larger(two->position[k], high[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        leaf->low[k] = lanes_least(low[k]);
        leaf->high[k] = lanes_greatest(high[k]);
    }
}

double bound_half_space_error(const octree_half_space *space, const level *l)
{
    double size = fabs(space->offset);
    for (int k = 0; k < 3; k++)
        size += fabs(space->normal[k]) * (find_farthest(l, k, 0) + l->reach[k] + l->unit * (MAX_STEPS + 2));
    return size * 0x1p-48 + 0x1p-1000;
}

/* Returns whether all positions of a leaf are certainly in a half-space, so that all of its bodies meet it. */
static bool holds_positions(const octree_half_space *space, const leaf_pairs *leaf, double error)
{
    double highest = -space->offset;
    for (int k = 0; k < 3; k++)
        highest += larger(space->normal[k] * leaf->low[k], space->normal[k] * leaf->high[k]);
    return highest < -error;
}

/* The corner of a body that is farthest against the normal decides. */
static uint64_t filter_by_half_space(const octree_half_space *space, const level *l, const leaf_pairs *leaf,
                                     double error)
{
    uint64_t outside = 0;
    lanes normal[3], slope[3];
    double limit = space->offset + error;
    for (int k = 0; k < 3; k++) {
        const half_steps half = half_steps_of(l, k);
        normal[k] = lanes_all(space->normal[k]);
        slope[k] = lanes_all(fabs(space->normal[k]) * half.step);
        limit += fabs(space->normal[k]) * half.rest;
    }
    for (unsigned i = 0; i < leaf->count; i += 2) {
        const two_bodies *two = &leaf->pairs[i / 2];
        lanes lowest = lanes_all(0);
        for (int k = 0; k < 3; k++)
            lowest = lanes_add(lowest, lanes_subtract(lanes_multiply(normal[k], two->position[k]),
                                                      lanes_multiply(slope[k], two->steps[k])));
        outside |= (uint64_t)lanes_less(lanes_all(limit), lowest) << begin_of_pair(leaf->count, i);
    }
    return outside;
}

uint64_t filter_by_half_spaces(const shape *s, const octree_point *points, unsigned count)
{
    leaf_pairs leaf;
    uint64_t near = UINT64_MAX >> (SCAN_POINTS - count);
    load_pairs(&leaf, points, count);
    for (size_t i = 0; i < s->region->half_space_count && near; i++) {
        const octree_half_space *space = &s->region->half_spaces[i];
        const double error = bound_half_space_error(space, s->level);
        if (!holds_positions(space, &leaf, error))
            near &= ~filter_by_half_space(space, s->level, &leaf, error);
    }
    return near;
}
