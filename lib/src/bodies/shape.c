/* SPDX-License-Identifier: MIT */
/* shape.c - the table of the kinds of regions; see shape_kind. */
#include "shape.h"
#include "../exact/float_mode.h"

static const shape_kind *const kinds[OCTREE_REGION_KINDS] = {
    [OCTREE_REGION_BOX] = &shape_of_box,
    [OCTREE_REGION_BALL] = &shape_of_ball,
    [OCTREE_REGION_HALF_SPACES] = &shape_of_half_spaces,
    [OCTREE_REGION_SWEPT] = &shape_of_cast,
    [OCTREE_REGION_RAY] = &shape_of_cast,
};

void shape_make(shape *s, const octree_region *region)
{
    s->kind = kinds[region->kind];
    s->region = region;
    if (s->kind->begin)
        s->kind->begin(s);
}

octree_status octree_region_check(const octree_region *region)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_region_check, region);
    if (!region)
        return OCTREE_NULL_ARGUMENT;
    return (unsigned)region->kind < OCTREE_REGION_KINDS ? kinds[region->kind]->check(region) : OCTREE_BAD_OPTION;
}
