/* SPDX-License-Identifier: MIT */
/* kind_frustum.c - the kind "frustum": the bodies or points that no half-space excludes. */
#include "../exact/body.h"
#include "kind.h"

octree_status run_frustum_query(query_run *run, octree_answer *answer)
{
    const octree_region region = {.kind = OCTREE_REGION_HALF_SPACES,
                                  .half_spaces = answer->frustum.half_spaces,
                                  .half_space_count = answer->frustum.count};
    return collect_bodies_in_region(run, &region);
}

/* A body that may be moved by `slack` is compared as a body whose box is larger by `slack`. */
int compare_body_to_frustum(const octree_answer *asked, const octree_body *body, double slack)
{
    octree_body larger_body = *body;
    int sign = -1;
    for (int i = 0; i < 3; i++) {
        larger_body.half[i] = slack > 0 ? exact_add_up(body->half[i], slack) : body->half[i];
        if (isinf(larger_body.half[i]))
            return -1;
    }
    for (size_t i = 0; i < asked->frustum.count; i++) {
        const octree_half_space *space = &asked->frustum.half_spaces[i];
        const int one = body_compare_half_space(&larger_body, space->normal, space->offset);
        sign = one > sign ? one : sign;
    }
    return sign;
}

/* Half-spaces are not bounded in general. */
octree_box find_bounds_of_frustum(const octree_answer *asked, double slack)
{
    (void)asked, (void)slack;
    return region_of_all_space().box;
}
