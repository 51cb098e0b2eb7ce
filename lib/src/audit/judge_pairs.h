/* SPDX-License-Identifier: MIT */
/* judge_pairs.h - compares the pairs of overlapping bodies that a foreign index found with the exact pairs. Private. */
#ifndef OCTREE_JUDGE_PAIRS_H
#define OCTREE_JUDGE_PAIRS_H

#include "judge.h"

/* The lists of octree_pair to which a judgement points. The owner of the lists empties them before each tick. */
typedef struct pair_lists {
    arena *memory;
    list *given, *missing, *extra;
} pair_lists;

/* A comparison function for qsort(): compares pairs by `a` and then by `b`. */
int compare_pairs(const void *a, const void *b);

/* Compare the pairs of a foreign index with the exact pairs, a list that is sorted with compare_pairs(). Store the
 * result in *made. Returns false if memory runs out. Cost: O(m log m), where m is the number of pairs of both. */
bool judge_pairs(const pair_lists *lists, const audited_points *points, const octree_foreign_pairs *given,
                 const list *exact, octree_pair_judgement *made);

#endif
