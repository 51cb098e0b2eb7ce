/* SPDX-License-Identifier: MIT */
/* jobs.h - records a session with several processes. Private to viz/record. */
#ifndef RECORD_JOBS_H
#define RECORD_JOBS_H

#include "recording.h"

/* Record the ticks of r->share with `jobs` processes. Calls recording_begin() and recording_end() itself. The playback
 * must be at tick 0. */
bool film_by_jobs(recording *r, playback *p, unsigned jobs, octreel_error *error);

#endif
