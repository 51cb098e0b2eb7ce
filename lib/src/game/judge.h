/* SPDX-License-Identifier: MIT */
/* judge.h - what a program answered to a query, judged by the true answer. Private. */
#ifndef OCTREE_JUDGE_H
#define OCTREE_JUDGE_H

#include "metric.h"
#include "octree/game.h"

/* A point of an answer as it is judged. */
typedef struct judged_point {
    octree_point point;
    double at[3];         /* its position, rounded where that is the program's promise */
    double square;        /* neighbours: of its scaled distance */
    const double *target; /* neighbours: for comparing by the distance */
} judged_point;

typedef struct judging {
    octree_game *game;
    const octree_query *query; /* with an answer */
    const octree_answer *answer;
    const octree_point *points; /* the true answer: answer->count points or neighbours */
    const octree_neighbor *neighbors;
    octree_skip skip; /* in force: that of the query, or the player */
    uint64_t skip_id;
} judging;

/* Judge an answer of the tick. NO_MEMORY, or OK. Cost: O(m log m) for m points of both answers; and under FLOATS one or
 * a few queries that have all points besides that rounding may bring in. */
octree_status judge(const judging *about, octree_judgement *made);

typedef bool point_test(const octree_point *point, void *context);
typedef octree_status point_visit(const octree_point *point, void *context);

/* Were an answer as good as it can be without the points for which `is_lost` is true: would it be wrong? Then `blame`
 * those of them that it misses. NO_MEMORY, what `blame` returned, or OK. Cost: as judge(), and where one of the true
 * neighbours is lost that of a ball that has them. */
octree_status judge_without(const judging *about, point_test *is_lost, point_visit *blame, void *context);

/* After all answers: point each judgement to its part of the lists, which do not grow any more. */
void judge_assign(octree_game *game);

#endif
