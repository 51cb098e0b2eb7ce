/* SPDX-License-Identifier: MIT */
/* kind_range.c - the kind "range": the points in a closed box. */
#include "../exact/exact.h"
#include "kind.h"
#include "search.h"

octree_status ask_range(query_run *run, octree_answer *answer)
{
    return octree_range_search(run->tree, &answer->box, &run->how, collect_unless_skipped, run);
}

/* Whether a - b <= length in real numbers; a and b may be infinite. */
static bool is_within_gap(double a, double b, double length)
{
    if (isinf(a) || isinf(b))
        return a <= b;
    return exact_sign_of_sum((double[]){a, -b, -length}, 3) <= 0;
}

bool contains_range(const octree_answer *asked, const double position[3], double slack)
{
    if (!(slack > 0))
        return box_contains(&asked->box, position);
    bool inside = true;
    for (int i = 0; i < 3; i++)
        inside &= is_within_gap(asked->box.min[i], position[i], slack) &&
                  is_within_gap(position[i], asked->box.max[i], slack);
    return inside;
}

octree_box bound_range(const octree_answer *asked, double slack)
{
    octree_box bound;
    for (int i = 0; i < 3; i++) {
        bound.min[i] = exact_add_down(asked->box.min[i], -slack);
        bound.max[i] = exact_add_up(asked->box.max[i], slack);
    }
    return bound;
}
