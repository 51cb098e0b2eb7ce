/* SPDX-License-Identifier: MIT */
/* kind.h - the functions that each kind of query defines, and run_query(), which asks a query of any kind.
 * octree/query.h has the table of kinds. Private. */
#ifndef OCTREE_KIND_H
#define OCTREE_KIND_H

#include "../bodies/set.h"
#include "octree/query.h"

/* Sort the points of a list from index `first` on, by id and then by position. */
void sort_points(list *points, size_t first);

/* A query that is being asked: its tree, its options, and the lists to which its result is appended. */
typedef struct query_run {
    const octree *tree;
    const octree_bodies *bodies; /* the points of `tree`, shown as bodies */
    bool extended;               /* false: all bodies are points, so that the queries of points answer */
    octree_search how;
    arena *memory;
    list *points;    /* a list of octree_point */
    list *neighbors; /* a list of octree_neighbor */
    const octree_answer *asked;
    bool failed; /* true: memory ran out, so the result lacks points */
} query_run;

/* An octree_point_visitor with a query_run as its context: append the point to the result unless the query skips it. */
bool collect_unless_skipped(const octree_point *point, void *context);

/* Returns a region that meets all bodies. */
static inline octree_region region_of_all_space(void)
{
    return (octree_region){.kind = OCTREE_REGION_BOX,
                           .box = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}}};
}

/* Append the bodies that match a region to the result, unless the query skips them. */
octree_status collect_bodies_in_region(query_run *run, const octree_region *region);

/* Append the first k bodies, in the order of octree_bodies_cast() for a ray, or of octree_bodies_nearest() to the
 * answer's target if `ray` is null. The distance of a neighbour is octree_hit.at. */
octree_status collect_first_bodies(query_run *run, const octree_answer *answer, const octree_region *ray);

/* Each kind defines a function run_NAME_query in kind_NAME.c, which asks the tree and appends the result, and the rules
 * of its kind of result. */
#define QUERY_RULE_TYPES(kind, name, ...)                                                                              \
    octree_status run_##name##_query(query_run *run, octree_answer *answer);                                           \
    int compare_body_to_##name(const octree_answer *asked, const octree_body *body, double slack);                     \
    octree_box find_bounds_of_##name(const octree_answer *asked, double slack);                                        \
    int compare_##name##_order(const octree_answer *asked, const octree_body *a, const octree_body *b);                \
    double measure_for_##name(const octree_answer *asked, const octree_body *body);                                    \
    octree_region find_region_of_##name(const octree_answer *asked, double reach, double slack);
OCTREE_QUERY_MAP(QUERY_RULE_TYPES)
#undef QUERY_RULE_TYPES

typedef struct query_rules {
    octree_status (*ask)(query_run *run, octree_answer *answer);

    /* The rules of kinds whose result is points; null for other kinds. */

    /* Compare a body with the region of a query, widened by a distance `slack` >= 0. Returns -1 if they overlap, 0 if
     * they only touch, 1 if they are apart. The comparison is exact,
     * whatever the sizes of the world and the region; if slack > 0, the boundary may be rounded outwards. */
    int (*compare)(const octree_answer *asked, const octree_body *body, double slack);

    /* Returns a closed box that contains the region and all positions at a distance of at most `slack` >= 0 from the
     * region. */
    octree_box (*bound)(const octree_answer *asked, double slack);

    /* The rules of kinds whose result is neighbours; null for other kinds. */

    /* Returns the sign of the difference of the keys of two bodies, in real numbers. A key is what the answer is sorted
     * by, such as the distance of the body. Bodies that no answer contains have one key, the greatest. */
    int (*order)(const octree_answer *asked, const octree_body *a, const octree_body *b);

    /* Returns the key of a body within 4 ulp, at most DBL_MAX. HUGE_VAL: no answer contains the body. */
    double (*measure)(const octree_answer *asked, const octree_body *body);

    /* Returns a region that meets every body whose key is at most `reach`, even after its position is moved by at most
     * `slack` >= 0. It may be larger. The searches that use it are valid. */
    octree_region (*region)(const octree_answer *asked, double reach, double slack);
} query_rules;

const query_rules *query_rules_of(octree_query_kind kind);

/* Returns whether a body exactly touches a query's region from outside. The query's result must be points, not
 * neighbours. */
static inline bool is_on_boundary(const octree_answer *asked, const octree_body *body)
{
    return query_rules_of(asked->kind)->compare(asked, body, 0) == 0;
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
