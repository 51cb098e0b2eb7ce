/* SPDX-License-Identifier: MIT */
/* shape_half_spaces.c - the bodies that no half-space of a region excludes; see shape_kind.
 *
 * A body is excluded if the sum normal . x - offset is certainly positive in its corner that is farthest against the
 * normal. Every sum has a bound of its error. A sum that overflows excludes nothing.
 *
 * The exact test of a body reads its row, which often is a cache miss. The filter reads only the points of a leaf,
 * which have the positions and upper bounds of the half extents (few_bodies.h).
 */
#include "shape.h"
#include "few_bodies.h"

static octree_status check(const octree_region *region)
{
    const octree_half_space *half_spaces = region->half_spaces;
    const size_t count = region->half_space_count;
    if (count == 0 || count > OCTREE_MAX_HALF_SPACES)
        return OCTREE_BAD_SIZE;
    if (!half_spaces)
        return OCTREE_NULL_ARGUMENT;
    octree_status status = OCTREE_OK;
    for (size_t i = 0; i < count && status == OCTREE_OK; i++)
        status = isfinite(half_spaces[i].offset) ? check_direction(half_spaces[i].normal) : OCTREE_NOT_FINITE;
    return status;
}

static bool meets(const shape *s, const octree_body *body)
{
    for (size_t i = 0; i < s->region->half_space_count; i++)
        if (!body_meets_half_space(body, s->region->half_spaces[i].normal, s->region->half_spaces[i].offset))
            return false;
    return true;
}

static bool contains(const shape *s, const octree_body *body)
{
    for (size_t i = 0; i < s->region->half_space_count; i++)
        if (!body_is_in_half_space(body, s->region->half_spaces[i].normal, s->region->half_spaces[i].offset))
            return false;
    return true;
}

static double bound_error(const octree_half_space *space, const level *l)
{
    double size = fabs(space->offset);
    for (int k = 0; k < 3; k++)
        size += fabs(space->normal[k]) * (find_farthest(l, k, 0) + l->reach[k] + l->unit * (MAX_STEPS + 2));
    return size * 0x1p-48 + 0x1p-1000;
}

static void prepare(shape *s)
{
    const level *l = s->level;
    for (size_t i = 0; i < s->region->half_space_count; i++) {
        const octree_half_space *space = &s->region->half_spaces[i];
        half_space_bounds *b = &s->half_spaces[i];
        b->error = bound_error(space, l);
        b->limit = space->offset + b->error;
        for (int k = 0; k < 3; k++) {
            const half_steps half = half_steps_of(l, k);
            b->slope[k] = fabs(space->normal[k]) * half.step;
            b->limit += fabs(space->normal[k]) * half.rest;
        }
    }
}

/* ---- Siblings ---------------------------------------------------------------------------------------------------- */

/* The least and the greatest values of normal . x in two boxes. */
typedef struct two_ranges {
    lanes least, greatest;
} two_ranges;

static inline two_ranges find_ranges(const octree_half_space *space, const few_boxes *few)
{
    two_ranges r = {lanes_all(0), lanes_all(0)};
    for (int k = 0; k < 3; k++) {
        const lanes normal = lanes_all(space->normal[k]);
        const lanes a = lanes_multiply(normal, few->min[k]), b = lanes_multiply(normal, few->max[k]);
        r.least = lanes_add(r.least, space->normal[k] < 0 ? b : a);
        r.greatest = lanes_add(r.greatest, space->normal[k] < 0 ? a : b);
    }
    return r;
}

static octant_masks relate_siblings_to_one(const octree_half_space *space, double error, const sibling_boxes *boxes)
{
    const lanes above = lanes_all(space->offset + error), below = lanes_all(space->offset - error);
    unsigned outside = 0, inside = 0;
    for (unsigned i = 0; i < boxes->count; i += LANES) {
        const unsigned at = begin_of_group(boxes->count, i);
        const few_boxes few = load_few_boxes(boxes, at);
        const two_ranges r = find_ranges(space, &few);
        outside |= lanes_less(above, r.least) << at;
        inside |= lanes_less(r.greatest, below) << at;
    }
    return (octant_masks){(uint8_t)~outside, (uint8_t)inside};
}

static octant_masks relate_siblings(const shape *s, const sibling_boxes *boxes)
{
    octant_masks all = {(uint8_t)mask_of_siblings(boxes), 0xff};
    for (size_t i = 0; i < s->region->half_space_count && all.meets; i++) {
        const octant_masks masks = relate_siblings_to_one(&s->region->half_spaces[i], s->half_spaces[i].error, boxes);
        all.meets &= masks.meets;
        all.inside &= masks.inside;
    }
    return all;
}

/* ---- The bodies of a leaf ---------------------------------------------------------------------------------------- */

/* The points of a leaf, and the box around their positions. */
typedef struct leaf_groups {
    few_bodies groups[SCAN_POINTS / LANES];
    unsigned count; /* of points */
    double low[3], high[3];
} leaf_groups;

static void load_groups(leaf_groups *leaf, const octree_point *points, unsigned count)
{
    lanes low[3], high[3];
    leaf->count = count;
    for (int k = 0; k < 3; k++) {
        low[k] = lanes_all(HUGE_VAL);
        high[k] = lanes_all(-HUGE_VAL);
    }
    for (unsigned i = 0; i < count; i += LANES) {
        few_bodies *few = &leaf->groups[i / LANES];
        *few = load_few_bodies(points, count, begin_of_group(count, i));
        for (int k = 0; k < 3; k++) {
            low[k] = lanes_smaller(few->position[k], low[k]);
            high[k] = lanes_larger(few->position[k], high[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        leaf->low[k] = lanes_least(low[k]);
        leaf->high[k] = lanes_greatest(high[k]);
    }
}

/* Returns whether all positions of a leaf are certainly in a half-space, so that all of its bodies meet it. */
static bool holds_positions(const octree_half_space *space, const leaf_groups *leaf, double error)
{
    double highest = -space->offset;
    for (int k = 0; k < 3; k++)
        highest += larger(space->normal[k] * leaf->low[k], space->normal[k] * leaf->high[k]);
    return highest < -error;
}

/* The corner of a body that is farthest against the normal decides. */
static uint64_t find_outside(const octree_half_space *space, const half_space_bounds *bounds, const leaf_groups *leaf)
{
    uint64_t outside = 0;
    for (unsigned i = 0; i < leaf->count; i += LANES) {
        const few_bodies *few = &leaf->groups[i / LANES];
        lanes lowest = lanes_all(0);
        for (int k = 0; k < 3; k++)
            lowest = lanes_add(lowest, lanes_subtract(lanes_multiply(lanes_all(space->normal[k]), few->position[k]),
                                                      lanes_multiply(lanes_all(bounds->slope[k]), few->steps[k])));
        outside |= (uint64_t)lanes_less(lanes_all(bounds->limit), lowest) << begin_of_group(leaf->count, i);
    }
    return outside;
}

static body_masks filter(const shape *s, const octree_point *points, unsigned count)
{
    leaf_groups leaf;
    uint64_t near = UINT64_MAX >> (SCAN_POINTS - count);
    load_groups(&leaf, points, count);
    for (size_t i = 0; i < s->region->half_space_count && near; i++) {
        const octree_half_space *space = &s->region->half_spaces[i];
        if (!holds_positions(space, &leaf, s->half_spaces[i].error))
            near &= ~find_outside(space, &s->half_spaces[i], &leaf);
    }
    return (body_masks){near, 0};
}

const shape_kind shape_of_half_spaces = {
    .check = check,
    .meets = meets,
    .contains = contains,
    .prepare = prepare,
    .relate_siblings = relate_siblings,
    .filter = filter,
};
