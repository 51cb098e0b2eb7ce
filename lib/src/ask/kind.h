/* SPDX-License-Identifier: MIT */
/* kind.h - the functions that each kind of query defines, and run_query(), which asks a query of any kind.
 * octree/query.h has the table of kinds. Private. */
#ifndef OCTREE_KIND_H
#define OCTREE_KIND_H

#include "octree/query.h"
#include "../tree/pool.h"

/* Sort the points of a list from index `first` on, by id and then by position. */
void sort_points(list *points, size_t first);

/* A query that is being asked: its tree, its options, and the lists to which its result is appended. */
typedef struct query_run {
    const octree *tree;
    octree_search how;
    arena *memory;
    list *points;    /* a list of octree_point */
    list *neighbors; /* a list of octree_neighbor */
    const octree_answer *asked;
    bool failed; /* true: memory ran out, so the result lacks points */
} query_run;

/* An octree_point_visitor with a query_run as its context: append the point to the result unless the query skips it. */
bool collect_unless_skipped(const octree_point *point, void *context);

/* Each kind defines a function run_NAME_query in kind_NAME.c, which asks the tree and appends the result. A kind whose
 * result is points also defines compare_position_to_NAME and find_bounds_of_NAME. */
#define QUERY_RULE_TYPES(kind, name, ...)                                                                              \
    octree_status run_##name##_query(query_run *run, octree_answer *answer);                                           \
    int compare_position_to_##name(const octree_answer *asked, const double position[3], double slack);                \
    octree_box find_bounds_of_##name(const octree_answer *asked, double slack);
OCTREE_QUERY_MAP(QUERY_RULE_TYPES)
#undef QUERY_RULE_TYPES

typedef struct query_rules {
    octree_status (*ask)(query_run *run, octree_answer *answer);

    /* Compare a position with the region of a query, widened by a distance `slack` >= 0. Returns -1 if the position is
     * inside, 0 on the boundary, 1 outside. The comparison is exact, whatever the sizes of the world and the region; if
     * slack > 0, the boundary may be rounded outwards. The function pointer is null for query kinds whose result is
     * neighbours. */
    int (*compare)(const octree_answer *asked, const double position[3], double slack);

    /* Returns a closed box that contains the region and all positions at a distance of at most `slack` >= 0 from the
     * region. The function pointer is null for query kinds whose result is neighbours. */
    octree_box (*bound)(const octree_answer *asked, double slack);
} query_rules;

const query_rules *query_rules_of(octree_query_kind kind);

/* Returns whether a position is exactly on the boundary of a query's region. The query's result must be points, not
 * neighbours. */
static inline bool is_on_boundary(const octree_answer *asked, const double position[3])
{
    return query_rules_of(asked->kind)->compare(asked, position, 0) == 0;
}

/* Returns whether the query has a foreign answer or pruned foreign nodes. The foreign answer and these nodes are then
 * compared with the exact answer. */
static inline bool is_query_judged(const octree_query *query)
{
    return query->answered || query->visits[OCTREE_NODE_PRUNED].count > 0;
}

/* Returns an answer without a result: a copy of the query's members, in which box and target are in world
 * coordinates. */
octree_answer make_answer_to_query(const octree_query *query, const double player[3]);

/* Round all positions and lengths among an answer's members to floats. */
void round_answer_to_floats(octree_answer *answer);

/* Ask a query that octree_query_check() accepts. The result is appended to the lists of the run, and answer->count
 * receives the number of appended items. The answer's pointers to points and neighbours stay null. */
octree_status run_query(query_run *run, const octree_query *query, const double player[3], octree_answer *answer);

#endif
