/* SPDX-License-Identifier: MIT */
/* filter.c - excludes bodies of a leaf that certainly do not meet a region: in doubles, two bodies at once.
 *
 * The exact test of a body reads its row, which often is a cache miss. A filter reads only the points of the leaf,
 * which have the positions and upper bounds of the half extents (two_bodies.h). Every sum has a bound of its error. A
 * value that overflows excludes nothing.
 */
#include "shape.h"
#include "../query/search.h"

/* Two bits of a mask; the same bit twice if the mask has only one. */
typedef struct bit_pair {
    unsigned a, b;
} bit_pair;

static inline bit_pair take_two_bits(uint64_t *mask)
{
    const unsigned a = bits_lowest(*mask);
    *mask &= *mask - 1;
    const unsigned b = *mask ? bits_lowest(*mask) : a;
    *mask &= *mask - 1;
    return (bit_pair){a, b};
}

/* ---- Boxes and balls ---------------------------------------------------------------------------------------- */

/* No error is added, because rounding is monotone: a rounded end of a body lies beyond a face only if the real one
 * does. */
uint64_t filter_by_box(const shape *s, const level *l, const octree_point *points, uint64_t near)
{
    lanes low[3], high[3];
    for (int i = 0; i < 3; i++) {
        low[i] = lanes_all(s->region->box.min[i]);
        high[i] = lanes_all(s->region->box.max[i]);
    }
    uint64_t apart = 0;
    for (uint64_t left = near; left;) {
        const bit_pair at = take_two_bits(&left);
        const two_bodies two = load_two_bodies(l, &points[at.a], &points[at.b]);
        unsigned pair = 0;
        for (int i = 0; i < 3; i++)
            pair |= lanes_less(lanes_add(two.center[i], two.most[i]), low[i]) |
                    lanes_less(high[i], lanes_subtract(two.center[i], two.most[i]));
        apart |= (uint64_t)(pair & 1) << at.a | (uint64_t)(pair >> 1) << at.b;
    }
    return near & ~apart;
}

/* The squares are not scaled: if the square of the radius underflows or overflows, few or no bodies are excluded. The
 * bound of a square leaves room for the error of the radius's square. */
uint64_t filter_by_ball(const shape *s, const level *l, const octree_point *points, uint64_t near)
{
    const lanes square = lanes_all(s->region->radius * s->region->radius);
    uint64_t apart = 0;
    for (uint64_t left = near; left;) {
        const bit_pair at = take_two_bits(&left);
        const two_bodies two = load_two_bodies(l, &points[at.a], &points[at.b]);
        const unsigned pair = lanes_less(square, bound_squares_of_two(s->region->center, 1, &two));
        apart |= (uint64_t)(pair & 1) << at.a | (uint64_t)(pair >> 1) << at.b;
    }
    return near & ~apart;
}

/* ---- Half-spaces -------------------------------------------------------------------------------------------- */

/* The points of a leaf, and the box around their positions. */
typedef struct leaf_pairs {
    two_bodies pairs[SCAN_POINTS / 2];
    bit_pair bits[SCAN_POINTS / 2];
    unsigned count;
    double low[3], high[3];
} leaf_pairs;

static void load_pairs(leaf_pairs *leaf, const level *l, const octree_point *points, uint64_t near)
{
    lanes low[3], high[3];
    leaf->count = 0;
    for (int k = 0; k < 3; k++) {
        low[k] = lanes_all(HUGE_VAL);
        high[k] = lanes_all(-HUGE_VAL);
    }
    while (near) {
        const bit_pair at = leaf->bits[leaf->count] = take_two_bits(&near);
        two_bodies *two = &leaf->pairs[leaf->count++];
        *two = load_two_bodies(l, &points[at.a], &points[at.b]);
        for (int k = 0; k < 3; k++) {
            low[k] = lanes_smaller(two->center[k], low[k]);
            high[k] = lanes_larger(two->center[k], high[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        double both[2][2];
        lanes_store(both[0], low[k]);
        lanes_store(both[1], high[k]);
        leaf->low[k] = both[0][0] < both[0][1] ? both[0][0] : both[0][1];
        leaf->high[k] = larger(both[1][0], both[1][1]);
    }
}

/* Returns a bound of the error of any sum of products of a half-space with bodies of the leaf. */
static double bound_half_space_error(const octree_half_space *space, const level *l, const leaf_pairs *leaf)
{
    double size = fabs(space->offset);
    for (int k = 0; k < 3; k++)
        size += fabs(space->normal[k]) * (larger(fabs(leaf->low[k]), fabs(leaf->high[k])) + l->reach[k]);
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
static uint64_t filter_by_half_space(const octree_half_space *space, const leaf_pairs *leaf, double error)
{
    uint64_t outside = 0;
    lanes normal[3], steep[3];
    const lanes limit = lanes_all(space->offset + error);
    for (int k = 0; k < 3; k++) {
        normal[k] = lanes_all(space->normal[k]);
        steep[k] = lanes_absolute(normal[k]);
    }
    for (unsigned i = 0; i < leaf->count; i++) {
        const two_bodies *two = &leaf->pairs[i];
        lanes lowest = lanes_all(0);
        for (int k = 0; k < 3; k++)
            lowest = lanes_add(lowest, lanes_subtract(lanes_multiply(normal[k], two->center[k]),
                                                      lanes_multiply(steep[k], two->most[k])));
        const unsigned pair = lanes_less(limit, lowest);
        outside |= (uint64_t)(pair & 1) << leaf->bits[i].a | (uint64_t)(pair >> 1) << leaf->bits[i].b;
    }
    return outside;
}

uint64_t filter_by_half_spaces(const shape *s, const level *l, const octree_point *points, uint64_t near)
{
    leaf_pairs leaf;
    load_pairs(&leaf, l, points, near);
    for (size_t i = 0; i < s->region->half_space_count && near; i++) {
        const octree_half_space *space = &s->region->half_spaces[i];
        const double error = bound_half_space_error(space, l, &leaf);
        if (!holds_positions(space, &leaf, error))
            near &= ~filter_by_half_space(space, &leaf, error);
    }
    return near;
}

/* ---- Rays and moving boxes ---------------------------------------------------------------------------------- */

uint64_t filter_by_cast(const shape *s, const level *l, const octree_point *points, uint64_t near)
{
    uint64_t apart = 0;
    for (uint64_t left = near; left;) {
        const bit_pair at = take_two_bits(&left);
        const two_bodies two = load_two_bodies(l, &points[at.a], &points[at.b]);
        const unsigned pair = lanes_less(lanes_all(DBL_MAX), bound_times_of_two(&s->cast_bounds, &two));
        apart |= (uint64_t)(pair & 1) << at.a | (uint64_t)(pair >> 1) << at.b;
    }
    return near & ~apart;
}
