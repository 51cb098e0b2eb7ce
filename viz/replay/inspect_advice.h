/* SPDX-License-Identifier: MIT */
/* inspect_advice.h - measures, on the points of a cloud, which leaf capacity and which epsilon make searches faster. */
#ifndef REPLAY_INSPECT_ADVICE_H
#define REPLAY_INSPECT_ADVICE_H

#include "inspect.h"

enum { ADVICE_CAPACITIES = 6, ADVICE_EPSILONS = 5, ADVICE_LEAST_POINTS = 100 };

/* All times are processor time. */
typedef struct capacity_row {
    size_t capacity;
    double build_ns; /* nanoseconds per point of a bulk build */
    double one_ns;   /* nanoseconds of a search for the nearest point */
    double eight_ns; /* nanoseconds of a search for the 8 nearest points */
    double bytes;    /* bytes of the tree's memory per point */
} capacity_row;

typedef struct epsilon_row {
    double epsilon;
    double eight_ns;    /* nanoseconds of a search for the 8 nearest points */
    double true_share;  /* the share of neighbours whose distance is that of the true neighbour of the same rank */
    double mean_ratio;  /* the mean ratio: the distance of a found neighbour / the true distance of the same rank */
    double worst_ratio; /* the largest ratio */
} epsilon_row;

typedef struct inspect_advice {
    size_t queries; /* the number of targets: places near points, whose neighbours are searched */
    capacity_row capacities[ADVICE_CAPACITIES];
    epsilon_row epsilons[ADVICE_EPSILONS]; /* the first is 0 */
    size_t capacity; /* the advised capacity: the tree's own, unless another one makes searches 1.1 times as fast */
    double epsilon;  /* the smallest epsilon that makes searches 1.1 times as fast; 0: none does */
} inspect_advice;

/* Measure all capacities and epsilons, and choose the advice. Returns false with an error if the cloud has fewer than
 * ADVICE_LEAST_POINTS points, or memory runs out. progress() of the watcher is called after each capacity. Cost:
 * ADVICE_CAPACITIES bulk builds and about a million searches. Memory: a second tree, and 32 bytes per point. */
bool inspect_advise(const inspection *i, const watcher *watch, inspect_advice *advice, octreel_error *error);

/* Print both tables and a sentence of advice, or one JSON object on one line. */
void inspect_print_advice(const inspect_advice *advice, const inspection *i, const char *name, bool json, FILE *out);

#endif
