/* SPDX-License-Identifier: MIT */
/* kind_radius.c - the kind "radius": the points in a ball. */
#include "../exact/body.h"
#include "kind.h"
#include "../query/search.h"

octree_status run_radius_query(query_run *run, octree_answer *answer)
{
    if (run->extended) {
        octree_region ball = {.kind = OCTREE_REGION_BALL, .radius = answer->radius};
        memcpy(ball.center, answer->target, sizeof ball.center);
        return collect_bodies_in_region(run, &ball);
    }
    return octree_radius(run->tree, answer->target, answer->radius, &run->how, collect_unless_skipped, run);
}

int compare_body_to_radius(const octree_answer *asked, const octree_body *body, double slack)
{
    const double reach = slack > 0 ? exact_add_up(asked->radius, slack) : asked->radius;
    return isinf(reach) ? -1 : body_compare_radius(body, asked->target, reach);
}

octree_box find_bounds_of_radius(const octree_answer *asked, double slack)
{
    const double reach = exact_add_up(asked->radius, slack);
    octree_box bound;
    for (int i = 0; i < 3; i++) {
        bound.min[i] = isinf(reach) ? -INFINITY : exact_add_down(asked->target[i], -reach);
        bound.max[i] = isinf(reach) ? INFINITY : exact_add_up(asked->target[i], reach);
    }
    return bound;
}
