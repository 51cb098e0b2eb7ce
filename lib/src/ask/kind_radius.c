/* SPDX-License-Identifier: MIT */
/* kind_radius.c - the kind "radius": the points in a ball. */
#include "../exact/exact.h"
#include "kind.h"
#include "../query/search.h"

octree_status run_radius_query(query_run *run, octree_answer *answer)
{
    return octree_radius(run->tree, answer->target, answer->radius, &run->how, collect_unless_skipped, run);
}

int compare_position_to_radius(const octree_answer *asked, const double position[3], double slack)
{
    const double reach = slack > 0 ? exact_add_up(asked->radius, slack) : asked->radius;
    return isinf(reach) ? -1 : metric_compare_radius(asked->target, position, reach);
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
