/* SPDX-License-Identifier: MIT */
/* judge.h - compares the answers of a foreign index with exact answers. Private. */
#ifndef OCTREE_JUDGE_H
#define OCTREE_JUDGE_H

#include "../bodies/set.h"
#include "octree/query.h"

/* A callback that copies the point with this id to *point. Returns false if no point has the id. */
typedef bool point_lookup(const void *context, uint64_t id, octree_point *point);

/* The points of the game, with which foreign answers and nodes are compared. */
typedef struct audited_points {
    const octree *tree;
    const octree_bodies *bodies; /* the points of `tree` with their half extents */
    point_lookup *find;
    const void *context; /* the context for `find`, passed as its first argument */
    /* the id of the player, if keys move the player: a foreign index need not contain this point; null: keys move no
     * player */
    const uint64_t *own_id;
} audited_points;

/* A point of the foreign answer or of the exact answer, with the numbers by which points are compared. */
typedef struct judged_point {
    octree_point point;
    octree_body body;           /* the point's body; its position is rounded if the foreign index promises floats */
    double key;                 /* for neighbours: query_rules.measure of the body */
    const octree_answer *asked; /* the members of the query */
} judged_point;

/* The two lists into which the judgements of a tick point, and two temporary lists. The owner of the struct empties
 * `given` and `wrong` before each tick. */
typedef struct judge {
    arena *memory;
    list given; /* a list of uint64_t: the ids of all foreign answers of the tick, one answer after another */
    /* a list of octree_point: the wrong points of each answer; first its missing points, then its extra points */
    list wrong;
    list foreign; /* a list of judged_point: the foreign answer that is being judged */
    list exact;   /* a list of judged_point: the exact answer to the same query */
} judge;

void judge_release(judge *j);

/* A query, and the exact answer to this query. */
typedef struct judged_query {
    const audited_points *points;
    const octree_query *query;
    /* the members of the query, epsilon and the number of results; its pointers to results are not read. exact_points
     * or exact_neighbors holds the results */
    const octree_answer *answer;
    /* the exact answer if it consists of points, else null; it has answer->count items */
    const octree_point *exact_points;
    /* the exact answer if it consists of neighbours, else null; it has answer->count items */
    const octree_neighbor *exact_neighbors;
    /* the skip that the search used: that of the query or, in a search for neighbours, possibly that of the player */
    octree_skip skip;
    uint64_t skip_id;
} judged_query;

/* Compare the foreign answer to a query with the exact answer, and store the result in *made. Returns false if memory
 * runs out. Cost: O(m log m), where m is the number of points in both answers. With OCTREE_FLOATS, add the cost of one
 * or more searches for the points that may be in the answer after rounding. */
bool judge_answer(judge *j, const judged_query *about, octree_judgement *made);

typedef bool point_test(const octree_point *point, void *context);
typedef bool point_visit(const octree_point *point, void *context);

/* The lost points are the points for which `is_lost` is true. Judge the best answer that contains no lost points. If
 * even this answer is wrong, call `report` for each lost point that is missing from the answer. Returns false if memory
 * runs out or `report` returns false. Cost: that of judge_answer(); if an exact neighbour is lost, also a search of a
 * ball that contains all exact neighbours. */
bool judge_without_lost_points(judge *j, const judged_query *about, point_test *is_lost, point_visit *report,
                               void *context);

/* Set the pointers of the judgements in `answers` to their parts of the lists `given` and `wrong`. The two lists must
 * not grow any more in this tick. */
void judge_assign_lists(const judge *j, octree_answer *answers, size_t count);

#endif
