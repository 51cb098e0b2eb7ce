/* SPDX-License-Identifier: MIT */
/* kind_range.c - the kind "range": the points in a box. */
#include "../exact/exact.h"
#include "kind.h"
#include "../query/search.h"

octree_status run_range_query(query_run *run, octree_answer *answer)
{
    if (run->extended)
        return collect_bodies_in_region(run, &(octree_region){.kind = OCTREE_REGION_BOX, .box = answer->box});
    return octree_range_search(run->tree, &answer->box, &run->how, collect_unless_skipped, run);
}

/* Returns the exact sign of a - b - half - length; a or b may be infinite. */
static int compare_gap(double a, double b, double half, double length)
{
    if (!(half > 0 || length > 0) || isinf(a) || isinf(b))
        return (a > b) - (a < b);
    return exact_sign_of_sum((double[]){a, -b, -half, -length}, 4);
}

int compare_body_to_range(const octree_answer *asked, const octree_body *body, double slack)
{
    int sign = -1;
    for (int i = 0; i < 3; i++) {
        const int below = compare_gap(asked->box.min[i], body->position[i], body->half[i], slack);
        const int above = compare_gap(body->position[i], asked->box.max[i], body->half[i], slack);
        sign = below > sign ? below : sign;
        sign = above > sign ? above : sign;
    }
    return sign;
}

octree_box find_bounds_of_range(const octree_answer *asked, double slack)
{
    octree_box bound;
    for (int i = 0; i < 3; i++) {
        bound.min[i] = exact_add_down(asked->box.min[i], -slack);
        bound.max[i] = exact_add_up(asked->box.max[i], slack);
    }
    return bound;
}
