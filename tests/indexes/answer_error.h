/* SPDX-License-Identifier: MIT */
/* answer_error.h - how wrong an answer is, compared with all points by real numbers. It shares no code with the
 * library. */
#ifndef ANSWER_ERROR_H
#define ANSWER_ERROR_H

#include "octree/query.h"

/* The difference between an answer and the truth. All zero, and a ratio of 1: the answer is right. */
typedef struct answer_error {
    size_t expected;  /* points of the right answer */
    size_t missing;   /* regions: points of the right answer that are not in this one; neighbours: ranks at which the
                         neighbour is farther than the true one, or does not exist */
    size_t extra;     /* regions: points that are not in the region; neighbours: more than k */
    size_t unknown;   /* ids of no point, points that occur again, points that are not finite */
    bool boundary;    /* regions: missing points exist, and all of them lie exactly on the boundary */
    double ratio;     /* neighbours: the largest distance / true distance of a rank; infinite if the true one is 0 */
    double ratio_sum; /* the sum of the ratios over all ranks that were answered */
} answer_error;

/* Judge the answer `ids` to a query about points whose ids are their places. Points with a NaN are in no right answer.
 * At most QUICK_NEAREST_MOST neighbours. `nearest`: the true neighbours, or null if they are to be found here. */
answer_error find_answer_error(const octree_query *query, const octree_point *points, size_t count, const uint64_t *ids,
                               size_t id_count, const octree_point *const *nearest);

/* Whether an answer is right by real numbers; among points at equal distances, any is right. */
bool is_right(const answer_error *error);

#endif
