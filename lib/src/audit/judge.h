/* SPDX-License-Identifier: MIT */
/* judge.h - compares the answers of a foreign index with exact answers. Private. */
#ifndef OCTREE_JUDGE_H
#define OCTREE_JUDGE_H

#include "metric.h"
#include "octree/query.h"
#include "pool.h"

/* Store the point that has an id; false where no point has it. */
typedef bool point_lookup(const void *context, uint64_t id, octree_point *point);

/* The points that foreign answers and nodes are compared with. */
typedef struct audited_points {
    const octree *tree;
    point_lookup *find;
    const void *context;    /* the first argument of `find` */
    const uint64_t *own_id; /* the point that a foreign index need not hold: the player that keys move; null for none */
} audited_points;

/* A point of an answer as it is compared. */
typedef struct judged_point {
    octree_point point;
    double at[3];  /* its position, rounded to floats where the foreign index promises floats */
    double square; /* its scaled squared distance to the target */
    const double *target;
} judged_point;

/* The lists to which the judgements of a tick refer, and two buffers. The owner empties `given` and `wrong` before a
 * tick. */
typedef struct judge {
    arena *memory;
    list given;   /* uint64_t: the ids of all foreign answers, one answer after another */
    list wrong;   /* octree_point: the missed and then the extra points of each answer */
    list foreign; /* judged_point: the foreign answer that is compared */
    list exact;   /* judged_point: the exact answer that is compared */
} judge;

void judge_release(judge *j);

/* One query with its exact answer. */
typedef struct judged_query {
    const audited_points *points;
    const octree_query *query;
    const octree_answer *answer;      /* the query's members and epsilon; the result is in the next two */
    const octree_point *exact_points; /* the exact answer if it consists of points, else null; answer->count items */
    const octree_neighbor *exact_neighbors; /* the exact answer if it consists of neighbours, else null */
    octree_skip skip;                       /* the skip in force: the query's, or the skip that leaves out the player */
    uint64_t skip_id;
} judged_query;

/* Judge the foreign answer of a query. False when there is no memory. Cost: O(m log m) for m points of both answers;
 * with OCTREE_FLOATS also one or more searches for the points that rounding may bring into the answer. */
bool judge_answer(judge *j, const judged_query *about, octree_judgement *made);

typedef bool point_test(const octree_point *point, void *context);
typedef bool point_visit(const octree_point *point, void *context);

/* Judge the best answer that leaves out all points for which `is_lost` is true. If even this answer is wrong, call
 * `report` for each lost point that it misses. False when there is no memory or `report` returned false. Cost: that of
 * judge_answer(), and where an exact neighbour is lost a search of a ball that contains them all. */
bool judge_without(judge *j, const judged_query *about, point_test *is_lost, point_visit *report, void *context);

/* Point the judgements of these answers to their parts of `given` and `wrong`, which must not grow any more. */
void judge_assign_lists(const judge *j, octree_answer *answers, size_t count);

#endif
