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

/* After all answers: point each judgement to its part of the lists, which do not grow any more. */
void judge_assign(octree_game *game);

#endif
