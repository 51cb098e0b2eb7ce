/* SPDX-License-Identifier: MIT */
/* shape_ball.c - the bodies in a ball; see shape_kind. */
#include "shape.h"

static octree_status check(const octree_region *region)
{
    const octree_status status = check_finite_position(region->center);
    return status == OCTREE_OK ? check_length(region->radius) : status;
}

static octree_box bounds_of_region(const shape *s)
{
    octree_box bounds;
    for (int i = 0; i < 3; i++) {
        bounds.min[i] = exact_add_down(s->region->center[i], -s->region->radius);
        bounds.max[i] = exact_add_up(s->region->center[i], s->region->radius);
    }
    return bounds;
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

/* If the radius is so large that its square overflows, no octant is excluded or inside. */
static octant_masks relate_octants(const shape *s, const cell_halves *h, unsigned octants, bool contained)
{
    double near[8], far[3][2];
    const double scale = s->level->tree->scale, radius = s->region->radius * scale, square = radius * radius;
    const double above = metric_above(square), below = square * (1 - 0x1p-40) - 0x1p-900;
    unsigned meets = 0, inside = 0;
    bound_squares_of_octants(&s->bounds, h, near);
    for (int i = 0; i < 3; i++)
        for (int half = 0; half < 2; half++) {
            const double center = h->center[i][half];
            const double extent = contained ? h->outer[i][half] : h->inner[i][half];
            far[i][half] = (fabs(s->region->center[i] - center) + extent) * scale;
        }
    for (unsigned left = octants; left; left &= left - 1) {
        const unsigned o = bits_lowest(left), x = o >> 2, y = o >> 1 & 1, z = o & 1;
        const double farthest = (far[0][x] * far[0][x] + far[1][y] * far[1][y]) + far[2][z] * far[2][z];
        meets |= mask_if(!(near[o] > above), 1u << o);
        inside |= mask_if(farthest < below && below <= DBL_MAX, 1u << o);
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
    .bounds = bounds_of_region,
    .meets = meets,
    .contains = contains,
    .prepare = prepare,
    .relate_octants = relate_octants,
    .relate_siblings = relate_siblings,
    .filter = filter,
};
