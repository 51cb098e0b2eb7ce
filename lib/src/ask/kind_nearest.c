/* SPDX-License-Identifier: MIT */
/* kind_nearest.c - the kinds "nearest" and "knearest": the point nearest to a target, or the k nearest points. */
#include "kind.h"
#include "octree/octree.h"

octree_status run_knearest_query(query_run *run, octree_answer *answer)
{
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
