/* SPDX-License-Identifier: MIT */
/* kind_nearest.c - the kinds "nearest" and "knearest": the point nearest to a target, or the k nearest points. */
#include "kind.h"
#include "octree/octree.h"

octree_status ask_knearest(asking *a, octree_answer *answer)
{
    const size_t first = a->neighbors->count, all = octree_count(a->tree);
    const size_t k = answer->k < all ? answer->k : all;
    while (a->neighbors->count < first + k)
        if (!list_append(a->points.memory, a->neighbors, sizeof(octree_neighbor)))
            return OCTREE_NO_MEMORY;
    octree_neighbor *neighbors = k ? (octree_neighbor *)a->neighbors->items + first : NULL;
    size_t found;
    const octree_status status = octree_nearest_k(a->tree, answer->target, k, &a->how, neighbors, &found);
    a->neighbors->count = first + found;
    return status;
}

octree_status ask_nearest(asking *a, octree_answer *answer)
{
    answer->k = 1;
    return ask_knearest(a, answer);
}
