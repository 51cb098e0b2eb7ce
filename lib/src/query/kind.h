/* SPDX-License-Identifier: MIT */
/* kind.h - the rules of a kind of query (octree/query.h has its row), and asking a query of any kind. Private. */
#ifndef OCTREE_KIND_H
#define OCTREE_KIND_H

#include "octree/query.h"
#include "pool.h"

/* Sort the points of a list from index `first` on, by id and then by position. */
void sort_points(list *points, size_t first);

/* A query that is being asked, and the lists that its result is appended to. */
typedef struct query_run {
    const octree *tree;
    octree_search how;
    arena *memory;
    list *points;    /* a list of octree_point */
    list *neighbors; /* a list of octree_neighbor */
    const octree_answer *asked;
    bool failed; /* there was no memory for a point */
} query_run;

/* An octree_point_visitor with a query_run as its context: collect the point unless the query skips it. */
bool collect_unless_skipped(const octree_point *point, void *context);

/* Each kind defines ask_NAME in kind_NAME.c: ask the tree and append the result. A kind whose result is points also
 * defines contains_NAME and bound_NAME. */
#define QUERY_RULE_TYPES(kind, name, ...)                                                                              \
    octree_status ask_##name(query_run *run, octree_answer *answer);                                                   \
    bool contains_##name(const octree_answer *asked, const double position[3], double slack);                          \
    octree_box bound_##name(const octree_answer *asked, double slack);
OCTREE_QUERY_MAP(QUERY_RULE_TYPES)
#undef QUERY_RULE_TYPES

typedef struct query_rules {
    octree_status (*ask)(query_run *run, octree_answer *answer);

    /* Whether a position is in the region or within `slack` >= 0 of it. Real numbers decide, whatever the world and the
     * size of the region; for slack > 0 the limit may be rounded up. Null where the result is neighbours. */
    bool (*contains)(const octree_answer *asked, const double position[3], double slack);

    /* A closed box that contains the region and everything within `slack` >= 0 of it. Null where the result is
     * neighbours. */
    octree_box (*bound)(const octree_answer *asked, double slack);
} query_rules;

const query_rules *query_rules_of(octree_query_kind kind);

/* Whether the exact answer must judge what a foreign index did for the query. */
static inline bool query_is_judged(const octree_query *query)
{
    return query->answered || query->visits[OCTREE_NODE_PRUNED].count > 0;
}

/* Store a query's members as an answer's, in world coordinates. */
octree_answer query_to_answer(const octree_query *query, const double player[3]);

/* Round all positions and lengths of an answer's members to floats. */
void round_answer(octree_answer *answer);

/* Ask a checked query. answer->count is the number of items that were appended to the lists of the run; the pointers
 * stay null. */
octree_status ask_query(query_run *run, const octree_query *query, const double player[3], octree_answer *answer);

#endif
