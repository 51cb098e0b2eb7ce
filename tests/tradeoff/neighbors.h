/* SPDX-License-Identifier: MIT */
/* neighbors.h - searches for the nearest points: timed, counted, and held against the truth. */
#ifndef TRADEOFF_NEIGHBORS_H
#define TRADEOFF_NEIGHBORS_H

#include "workload.h"

/* One way to ask for the nearest k points, at most TRUE_NEIGHBORS, of every target of a workload. */
typedef struct asking {
    const octree *tree;
    workload *load;
    octree_search how; /* its cost is null: counting takes time */
    size_t k;
} asking;

/* A timed_work of an asking. */
void ask_all(void *contestant);

/* What the answers were. An excess is (distance found / true distance) - 1, of the i-th found to the true i-th. */
typedef struct findings {
    size_t asked;  /* targets */
    size_t wrong;  /* targets with another point than the true one first */
    double worst;  /* excess; where it is within the bound by the real numbers it is not above it here */
    double mean;   /* of finite ones */
    double recall; /* share of the true k that were found */
    octree_cost cost;
} findings;

findings judge_answers(const asking *a);

/* The excess that octree_nearest_k promises for this way to ask. */
double promised_excess(const octree_search *how);

/* The excess of a found point, judged as above; `world` is the tree's. */
double excess_of(const octree_search *how, const octree_box *world, const double target[3], const double found[3],
                 const double truth[3]);

#endif
