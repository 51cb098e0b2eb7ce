/* SPDX-License-Identifier: MIT */
/* relate.c - relates the boxes of siblings to a region, in doubles.
 *
 * A node is excluded if its box certainly does not meet the region. It is taken whole if its box is certainly in the
 * region; then so are all of its bodies. Boxes that are unknown are infinite. They meet every region, and are in none,
 * because a sum that is NaN decides nothing.
 */
#include "../query/search.h"
#include "shape.h"

/* ---- Boxes and balls ---------------------------------------------------------------------------------------- */

static octant_masks relate_to_box(const shape *s, const sibling_boxes *boxes)
{
    const unsigned meets = test_boxes(&s->bounds, boxes);
    unsigned inside = 0;
    for (unsigned left = meets; left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        inside |= (unsigned)contains_box(&s->region->box, &boxes->items[i]) << i;
    }
    return (octant_masks){(uint8_t)meets, (uint8_t)inside};
}

/* Returns the square of the distance from a target to the farthest corner of a box, multiplied by that of a scale. */
static double find_farthest_square(const double target[3], double scale, const octree_box *box)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const double way = larger(target[k] - box->min[k], box->max[k] - target[k]) * scale;
        sum += way * way;
    }
    return sum;
}

static octant_masks relate_to_ball(const shape *s, const sibling_boxes *boxes)
{
    double bounds[8];
    const double scale = s->level->tree->scale, radius = s->region->radius * scale, square = radius * radius;
    unsigned inside = 0;
    const unsigned meets = bound_squares_of_boxes(&s->bounds, boxes, metric_above(square), bounds);
    for (unsigned left = meets; left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        const double farthest = find_farthest_square(s->region->center, scale, &boxes->items[i]);
        inside |= (unsigned)(farthest < metric_below(square)) << i;
    }
    return (octant_masks){(uint8_t)meets, (uint8_t)inside};
}

/* ---- Half-spaces -------------------------------------------------------------------------------------------- */

/* The least and the greatest values of normal . x in two boxes. */
typedef struct two_ranges {
    lanes least, greatest;
} two_ranges;

static inline two_ranges find_ranges(const octree_half_space *space, const two_boxes *two)
{
    two_ranges r = {lanes_all(0), lanes_all(0)};
    for (int k = 0; k < 3; k++) {
        const lanes normal = lanes_all(space->normal[k]);
        const lanes a = lanes_multiply(normal, two->min[k]), b = lanes_multiply(normal, two->max[k]);
        r.least = lanes_add(r.least, space->normal[k] < 0 ? b : a);
        r.greatest = lanes_add(r.greatest, space->normal[k] < 0 ? a : b);
    }
    return r;
}

static octant_masks relate_to_one_half_space(const octree_half_space *space, const level *l, const sibling_boxes *boxes)
{
    const double error = bound_half_space_error(space, l);
    const lanes above = lanes_all(space->offset + error), below = lanes_all(space->offset - error);
    unsigned outside = 0, inside = 0;
    for (unsigned i = 0; i < boxes->count; i += 2) {
        const unsigned at = begin_of_pair(boxes->count, i);
        const two_boxes two = load_two_boxes(boxes, at);
        const two_ranges r = find_ranges(space, &two);
        outside |= lanes_less(above, r.least) << at;
        inside |= lanes_less(r.greatest, below) << at;
    }
    return (octant_masks){(uint8_t)~outside, (uint8_t)inside};
}

static octant_masks relate_to_half_spaces(const shape *s, const sibling_boxes *boxes)
{
    octant_masks all = {(uint8_t)mask_of_siblings(boxes), 0xff};
    for (size_t i = 0; i < s->region->half_space_count && all.meets; i++) {
        const octant_masks masks = relate_to_one_half_space(&s->region->half_spaces[i], s->level, boxes);
        all.meets &= masks.meets;
        all.inside &= masks.inside;
    }
    return all;
}

/* ---- Rays and moving boxes ---------------------------------------------------------------------------------- */

static octant_masks relate_to_cast(const shape *s, const sibling_boxes *boxes)
{
    double bounds[8];
    return (octant_masks){(uint8_t)bound_times_of_boxes(&s->bounds, boxes, DBL_MAX, bounds), 0};
}

/* ---- The table ---------------------------------------------------------------------------------------------- */

/* Functions that return masks of siblings: bit i is for sibling i. */
static octant_masks (*const kinds[OCTREE_REGION_KINDS])(const shape *s, const sibling_boxes *boxes) = {
    [OCTREE_REGION_BOX] = relate_to_box,
    [OCTREE_REGION_BALL] = relate_to_ball,
    [OCTREE_REGION_HALF_SPACES] = relate_to_half_spaces,
    [OCTREE_REGION_SWEPT] = relate_to_cast,
    [OCTREE_REGION_RAY] = relate_to_cast,
};

octant_masks shape_relate_children(const shape *s, const node *n)
{
    const sibling_boxes boxes = boxes_of_children(n);
    const octant_masks masks = kinds[s->region->kind](s, &boxes);
    return (octant_masks){(uint8_t)spread_mask(n, masks.meets), (uint8_t)spread_mask(n, masks.inside)};
}
