/* SPDX-License-Identifier: MIT */
/* kind_sweep.c - the kind "sweep": the first k bodies or points that a moving box hits, in the order of the hits. */
#include "hits.h"

static octree_region make_sweep(const octree_answer *asked, double slack)
{
    octree_region sweep = {.kind = OCTREE_REGION_SWEPT};
    memcpy(sweep.from, asked->target, sizeof sweep.from);
    memcpy(sweep.to, asked->to, sizeof sweep.to);
    for (int i = 0; i < 3; i++)
        sweep.half[i] = slack > 0 ? exact_add_up(asked->half[i], slack) : asked->half[i];
    return sweep;
}

octree_status run_sweep_query(query_run *run, octree_answer *answer)
{
    const octree_region sweep = make_sweep(answer, 0);
    return collect_first_bodies(run, answer, &sweep);
}

/* ---- Rules -------------------------------------------------------------------------------------------------- */

int compare_sweep_order(const octree_answer *asked, const octree_body *a, const octree_body *b)
{
    const cast sweep = cast_make_sweep(asked->target, asked->to, asked->half);
    return compare_hits_of_cast(&sweep, a, b);
}

double measure_for_sweep(const octree_answer *asked, const octree_body *body)
{
    const cast sweep = cast_make_sweep(asked->target, asked->to, asked->half);
    return measure_hit_of_cast(&sweep, body);
}

/* The whole way: a box that hits a body hits it also after a move by `slack` if the box is larger by as much. */
octree_region find_region_of_sweep(const octree_answer *asked, double reach, double slack)
{
    (void)reach;
    const octree_region sweep = make_sweep(asked, slack);
    return octree_region_check(&sweep) == OCTREE_OK ? sweep : region_of_all_space();
}
