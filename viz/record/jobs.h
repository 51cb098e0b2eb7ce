/* SPDX-License-Identifier: MIT */
/* jobs.h - a recording by several processes, since contexts in threads of one process do not scale.
 *
 * Each process plays the whole session and films a share of its ticks, every N-th frame; the one that started them
 * collects their lines in the order of the ticks. So the lines are those of one process, and so is what is left where
 * the recording is stopped or breaks off: all up to some tick, and a few frames beyond it. Private to this folder. */
#ifndef RECORD_JOBS_H
#define RECORD_JOBS_H

#include "recording.h"

/* Film the share of a recording by so many processes, from begin to end; the playback is at tick 0. */
bool film_by_jobs(recording *r, playback *p, unsigned jobs, octreel_error *error);

#endif
