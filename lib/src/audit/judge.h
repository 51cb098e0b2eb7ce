/* SPDX-License-Identifier: MIT */
/* judge.h - compares the answers of a foreign index with exact answers. Private. */
#ifndef OCTREE_JUDGE_H
#define OCTREE_JUDGE_H

#include "../exact/metric.h"
#include "octree/query.h"
#include "../tree/pool.h"

/* Copy the point that has an id to *point. False if no point has the id. */
typedef bool point_lookup(const void *context, uint64_t id, octree_point *point);

/* The points of the game, with which foreign answers and nodes are compared. */
typedef struct audited_points {
    const octree *tree;
    point_lookup *find;
    const void *context;    /* the context for `find`, passed as its first argument */
    const uint64_t *own_id; /* the id of the player if keys move it; a foreign index need not hold this point. Null:
                               there is none */
} audited_points;

/* A point of the foreign or the exact answer, with the values that are compared. */
typedef struct judged_point {
    octree_point point;
    double at[3];  /* the point's position, rounded to floats if the foreign index promises floats */
    double square; /* the scaled squared distance from the point to the target */
    const double *target;
} judged_point;

/* The lists to which a tick's judgements refer, and two lists for temporary use. The owner empties `given` and `wrong`
 * before a tick. */
typedef struct judge {
    arena *memory;
    list given;   /* a list of uint64_t: the ids of all foreign answers, one answer after another */
    list wrong;   /* a list of octree_point: for each answer its missing points, then its extra points */
    list foreign; /* a list of judged_point: the foreign answer that is being judged */
    list exact;   /* a list of judged_point: the exact answer to the same query */
} judge;

void judge_release(judge *j);

/* A query and the exact answer to it. */
typedef struct judged_query {
    const audited_points *points;
    const octree_query *query;
    const octree_answer *answer; /* the query's members, epsilon and the count; the next two pointers hold the result */
    /* the exact answer if it consists of points, else null; it has answer->count items */
    const octree_point *exact_points;
    /* the exact answer if it consists of neighbours, else null; it has answer->count items */
    const octree_neighbor *exact_neighbors;
    octree_skip skip; /* the skip that applied: the query's skip, or for neighbours the skip of the player */
    uint64_t skip_id;
} judged_query;

/* Judge the foreign answer to a query. False when there is no memory. Cost: O(m log m) for m points of both answers;
 * with OCTREE_FLOATS also one or more searches for points that rounding may bring into the answer. */
bool judge_answer(judge *j, const judged_query *about, octree_judgement *made);

typedef bool point_test(const octree_point *point, void *context);
typedef bool point_visit(const octree_point *point, void *context);

/* Judge the best answer without the lost points, which are the points for which `is_lost` is true. If even the best
 * answer is wrong, call `report` for each lost point that it lacks. False when there is no memory or `report` returned
 * false. Cost: that of judge_answer(). If an exact neighbour is lost, also a search of a ball that contains all exact
 * neighbours. */
bool judge_without_lost_points(judge *j, const judged_query *about, point_test *is_lost, point_visit *report,
                               void *context);

/* Set the pointers of these answers' judgements to their parts of `given` and `wrong`. These two lists must not grow
 * any more in this tick. */
void judge_assign_lists(const judge *j, octree_answer *answers, size_t count);

#endif
