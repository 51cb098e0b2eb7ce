/* SPDX-License-Identifier: MIT */
/* kind_ray.c - the kind "ray": the first k bodies or points that a ray hits, in the order of the hits. */
#include "hits.h"
#include "../query/search.h"

static double find_end(const octree_answer *asked)
{
    return asked->length > 0 ? asked->length : HUGE_VAL;
}

static octree_region make_ray(const octree_answer *asked, double length, double thickness)
{
    octree_region ray = {.kind = OCTREE_REGION_RAY, .length = length};
    memcpy(ray.origin, asked->target, sizeof ray.origin);
    memcpy(ray.direction, asked->direction, sizeof ray.direction);
    for (int i = 0; i < 3; i++)
        ray.half[i] = thickness;
    return ray;
}

octree_status run_ray_query(query_run *run, octree_answer *answer)
{
    const octree_region ray = make_ray(answer, find_end(answer), answer->thickness);
    return collect_first_bodies(run, answer, &ray);
}

/* ---- Rules -------------------------------------------------------------------------------------------------- */

static cast make_cast(const octree_answer *asked)
{
    const double half[3] = {asked->thickness, asked->thickness, asked->thickness};
    return cast_make_ray(asked->target, asked->direction, find_end(asked), half);
}

int compare_ray_order(const octree_answer *asked, const octree_body *a, const octree_body *b)
{
    const cast ray = make_cast(asked);
    return compare_hits_of_cast(&ray, a, b);
}

double measure_for_ray(const octree_answer *asked, const octree_body *body)
{
    const cast ray = make_cast(asked);
    return measure_hit_of_cast(&ray, body);
}

/* A ray that hits a body hits it also after a move by `slack` if the ray is thicker by as much. The length is rounded
 * up, because keys have an error. */
octree_region find_region_of_ray(const octree_answer *asked, double reach, double slack)
{
    const double longer = reach * (1 + 0x1p-40) + 0x1p-1000, end = find_end(asked);
    const double thickness = exact_add_up(asked->thickness, slack);
    if (thickness <= DBL_MAX)
        return make_ray(asked, reach < DBL_MAX && longer < end ? longer : end, thickness);
    return region_of_all_space();
}
