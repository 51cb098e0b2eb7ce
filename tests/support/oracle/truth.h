/* SPDX-License-Identifier: MIT */
/* truth.h - decides whether an answer is right by comparing all points with real numbers. It shares no code with the
 * library. */
#ifndef TRUTH_H
#define TRUTH_H

#include "octree/game.h"

#include <stdbool.h>

typedef enum truth { TRUTH_RIGHT, TRUTH_WRONG, TRUTH_OPEN } truth;

/* Judge query->answer by all points, which have the ids 0, 1, 2 ... TRUTH_OPEN: the answer exceeds what epsilon allows
 * by so little that octree_judgement does not call it wrong. There are at most TRUTH_POINTS points. */
#define TRUTH_POINTS 1024
truth truth_of(const octree_query *query, const octree_point *points, size_t count);

/* The float that is nearest to x, or the largest one: what a program stores that holds floats. */
double round_to_float(double x);

#endif
