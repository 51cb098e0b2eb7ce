/* SPDX-License-Identifier: MIT */
/* judge.h - compares the calls of a visitor with the points of the exact answer. */
#ifndef CAMPAIGN_JUDGE_H
#define CAMPAIGN_JUDGE_H

#include "trial.h"

/* Forget what was found; the visitor will ask to stop at a call, or never for 0. */
void gather_begin(trial *t, size_t stop_at);

/* The visitor; its context is &trial.found. */
bool gather(const octree_point *point, void *context);

/* Whether each point was found once that must be, and none that must not, by trial.verdicts. */
bool judge(trial *t, const char *question);

/* The same of a visitor that stopped: as many calls as it allowed, and nothing but what belongs. */
bool judge_stopped(trial *t, const char *question);

#endif
