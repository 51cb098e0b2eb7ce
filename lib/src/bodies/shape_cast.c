/* SPDX-License-Identifier: MIT */
/* shape_cast.c - the bodies that a ray hits, and those that a moving box touches; see shape_kind. No body is contained.
 */
#include "shape.h"

static octree_status check_ray(const octree_region *region)
{
    octree_status status = check_finite_position(region->origin);
    if (status == OCTREE_OK)
        status = check_direction(region->direction);
    if (status == OCTREE_OK)
        status = isnan(region->length) ? OCTREE_NOT_FINITE : region->length < 0 ? OCTREE_BAD_SIZE : OCTREE_OK;
    return status == OCTREE_OK ? check_half_extents(region->half) : status;
}

static octree_status check_swept(const octree_region *region)
{
    if (!is_finite_position(region->from) || !is_finite_position(region->to))
        return OCTREE_NOT_FINITE;
    return check_half_extents(region->half);
}

static octree_status check(const octree_region *region)
{
    return region->kind == OCTREE_REGION_RAY ? check_ray(region) : check_swept(region);
}

cast make_cast_of_region(const octree_region *region)
{
    if (region->kind == OCTREE_REGION_RAY)
        return cast_make_ray(region->origin, region->direction, region->length, region->half);
    return cast_make_sweep(region->from, region->to, region->half);
}

static void begin(shape *s)
{
    s->cast = make_cast_of_region(s->region);
}

static bool meets(const shape *s, const octree_body *body)
{
    cast_time first;
    return cast_touches(&s->cast, body, &first);
}

static void prepare(shape *s)
{
    prepare_times(&s->bounds, s->level, &s->cast);
}

static octant_masks relate_siblings(const shape *s, const sibling_boxes *boxes)
{
    double bounds[8];
    return (octant_masks){(uint8_t)s->bounds.in_lanes->times_of_boxes(&s->bounds, boxes, DBL_MAX, bounds), 0};
}

static body_masks filter(const shape *s, const octree_point *points, unsigned count)
{
    double bounds[SCAN_POINTS];
    return (body_masks){s->bounds.in_lanes->times(&s->bounds, points, count, DBL_MAX, bounds), 0};
}

const shape_kind shape_of_cast = {
    .check = check,
    .begin = begin,
    .meets = meets,
    .prepare = prepare,
    .relate_siblings = relate_siblings,
    .filter = filter,
};
