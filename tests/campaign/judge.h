/* SPDX-License-Identifier: MIT */
/* judge.h - compares the calls of a visitor with the points of the exact answer. */
#ifndef CAMPAIGN_JUDGE_H
#define CAMPAIGN_JUDGE_H

#include "trial.h"

/* Forget the found points. The visitor stops at this call; 0: never. */
void gather_begin(trial *t, size_t stop_at);

/* The visitor; its context is &trial.found. */
bool gather(const octree_point *point, void *context);

/* Whether each point that must be found was found once, and no other, by trial.verdicts. */
bool judge(trial *t, const char *question);

/* The same for a visitor that stopped: the right number of calls, and only points of the answer. */
bool judge_stopped(trial *t, const char *question);

#endif
