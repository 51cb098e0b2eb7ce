/* SPDX-License-Identifier: MIT */
/* shape_box.c - the bodies in a box; see shape_kind. */
#include "box_faces.h"
#include "shape.h"

static octree_status check(const octree_region *region)
{
    return check_box(&region->box);
}

static bool meets(const shape *s, const octree_body *body)
{
    return body_meets_box(body, &s->region->box);
}

static bool contains(const shape *s, const octree_body *body)
{
    return body_is_in_box(body, &s->region->box);
}

static void prepare(shape *s)
{
    prepare_box_test(&s->bounds, s->level, &s->region->box);
}

static octant_masks relate_siblings(const shape *s, const sibling_boxes *boxes)
{
    const unsigned meets = s->bounds.in_lanes->boxes_meet(&s->bounds, boxes);
    unsigned inside = 0;
    for (unsigned left = meets; left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        inside |= (unsigned)contains_box(&s->region->box, &boxes->items[i]) << i;
    }
    return (octant_masks){(uint8_t)meets, (uint8_t)inside};
}

static body_masks filter(const shape *s, const octree_point *points, unsigned count)
{
    return s->bounds.in_lanes->meets(&s->bounds, points, count);
}

const shape_kind shape_of_box = {
    .check = check,
    .meets = meets,
    .contains = contains,
    .prepare = prepare,
    .relate_siblings = relate_siblings,
    .filter = filter,
};
