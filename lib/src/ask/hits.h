/* SPDX-License-Identifier: MIT */
/* hits.h - the rules of kinds whose result is the hits of a cast, in their order. Private. */
#ifndef OCTREE_HITS_H
#define OCTREE_HITS_H

#include "../exact/cast.h"
#include "kind.h"

/* Bodies that the cast misses come after all hits, and among them no order is known. */
static inline int compare_hits_of_cast(const cast *c, const octree_body *a, const octree_body *b)
{
    cast_time first;
    const bool hits_a = cast_touches(c, a, &first), hits_b = cast_touches(c, b, &first);
    return hits_a && hits_b ? cast_compare(c, a, b) : hits_b - hits_a;
}

static inline double measure_hit_of_cast(const cast *c, const octree_body *body)
{
    cast_time first;
    if (!cast_touches(c, body, &first))
        return HUGE_VAL;
    const double time = cast_first_time(c, body);
    return time < DBL_MAX ? time : DBL_MAX;
}

#endif
