/* SPDX-License-Identifier: MIT */
/* jobs.h - records a session with several processes. Private to this folder. */
#ifndef RECORD_JOBS_H
#define RECORD_JOBS_H

#include "recording.h"

/* Record a share with this many processes, from recording_begin() to recording_end(). The playback is at tick 0. */
bool film_by_jobs(recording *r, playback *p, unsigned jobs, octreel_error *error);

#endif
