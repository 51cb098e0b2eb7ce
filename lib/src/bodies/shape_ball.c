/* SPDX-License-Identifier: MIT */
/* shape_ball.c - the bodies in a ball; see shape_kind. */
#include "shape.h"

static octree_status check(const octree_region *region)
{
    const octree_status status = check_finite_position(region->center);
    return status == OCTREE_OK ? check_length(region->radius) : status;
}

static bool meets(const shape *s, const octree_body *body)
{
    return body_meets_ball(body, s->region->center, s->region->radius);
}

static bool contains(const shape *s, const octree_body *body)
{
    return body_is_in_ball(body, s->region->center, s->region->radius);
}

static void prepare(shape *s)
{
    prepare_squares(&s->bounds, s->level, s->region->center);
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

static octant_masks relate_siblings(const shape *s, const sibling_boxes *boxes)
{
    double bounds[8];
    const double scale = s->level->tree->scale, radius = s->region->radius * scale, square = radius * radius;
    unsigned inside = 0;
    const unsigned meets = s->bounds.in_lanes->squares_of_boxes(&s->bounds, boxes, metric_above(square), bounds);
    for (unsigned left = meets; left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        const double farthest = find_farthest_square(s->region->center, scale, &boxes->items[i]);
        inside |= (unsigned)(farthest < metric_below(square)) << i;
    }
    return (octant_masks){(uint8_t)meets, (uint8_t)inside};
}

static body_masks filter(const shape *s, const octree_point *points, unsigned count)
{
    double bounds[SCAN_POINTS];
    const double radius = s->region->radius * s->level->tree->scale;
    return (body_masks){s->bounds.in_lanes->squares(&s->bounds, points, count, metric_above(radius * radius), bounds),
                        0};
}

const shape_kind shape_of_ball = {
    .check = check,
    .meets = meets,
    .contains = contains,
    .prepare = prepare,
    .relate_siblings = relate_siblings,
    .filter = filter,
};
