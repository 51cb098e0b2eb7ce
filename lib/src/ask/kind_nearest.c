/* SPDX-License-Identifier: MIT */
/* kind_nearest.c - the kinds "nearest" and "knearest": the point nearest to a target, or the k nearest points. */
#include "../exact/body.h"
#include "kind.h"
#include "../query/search.h"

octree_status run_knearest_query(query_run *run, octree_answer *answer)
{
    if (run->extended)
        return collect_first_bodies(run, answer, NULL);
    const size_t first = run->neighbors->count, all = octree_count(run->tree);
    const size_t k = answer->k < all ? answer->k : all;
    while (run->neighbors->count < first + k)
        if (!list_append(run->memory, run->neighbors, sizeof(octree_neighbor)))
            return OCTREE_NO_MEMORY;
    octree_neighbor *neighbors = k ? (octree_neighbor *)run->neighbors->items + first : NULL;
    size_t found;
    const octree_status status = octree_nearest_k(run->tree, answer->target, k, &run->how, neighbors, &found);
    run->neighbors->count = first + found;
    return status;
}

octree_status run_nearest_query(query_run *run, octree_answer *answer)
{
    answer->k = 1;
    return run_knearest_query(run, answer);
}

/* ---- Rules -------------------------------------------------------------------------------------------------- */

int compare_knearest_order(const octree_answer *asked, const octree_body *a, const octree_body *b)
{
    return body_compare_distances(a, b, asked->target);
}

double measure_for_knearest(const octree_answer *asked, const octree_body *body)
{
    const double distance = body_distance(body, asked->target);
    return distance < DBL_MAX ? distance : DBL_MAX;
}

octree_region find_region_of_knearest(const octree_answer *asked, double reach, double slack)
{
    octree_region region = {.kind = OCTREE_REGION_BALL, .radius = exact_add_up(reach, slack)};
    memcpy(region.center, asked->target, sizeof region.center);
    return region.radius <= DBL_MAX ? region : region_of_all_space();
}

int compare_nearest_order(const octree_answer *asked, const octree_body *a, const octree_body *b)
{
    return compare_knearest_order(asked, a, b);
}

double measure_for_nearest(const octree_answer *asked, const octree_body *body)
{
    return measure_for_knearest(asked, body);
}

octree_region find_region_of_nearest(const octree_answer *asked, double reach, double slack)
{
    return find_region_of_knearest(asked, reach, slack);
}
