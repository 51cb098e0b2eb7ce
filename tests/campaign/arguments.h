/* SPDX-License-Identifier: MIT */
/* arguments.h - random arguments for operations: on points, one or two doubles beside them, between them, and far away.
 * Each statement draws at most one random number, because compilers evaluate operands in different orders. */
#ifndef CAMPAIGN_ARGUMENTS_H
#define CAMPAIGN_ARGUMENTS_H

#include "trial.h"

/* A position for a change: mostly one of the scene's places, at times outside the world or not finite. */
void any_position(trial *t, double at[3]);

/* A stored pair, or now and then one that may not be stored. */
octree_point any_pair(trial *t);

uint64_t any_id(trial *t);

/* A finite position for a question. */
void any_target(trial *t, double at[3]);

/* A length >= 0 for a ball: zero, the distance to a point or a double beside it, or a part of the world. */
double any_radius(trial *t, const double center[3]);

/* A length >= 0 for a box about a centre: zero, the distance to a point on one axis or a double beside it, ... */
double any_size(trial *t, const double center[3]);

/* A ratio of neighbours, and a length of ranges; zero half of the time. */
double any_ratio(trial *t);
double any_slack(trial *t, const double center[3]);

octree_box any_box(trial *t);

/* A search with skip, mode and cost; no epsilon. */
octree_search any_search(trial *t);

#endif
