/* SPDX-License-Identifier: MIT */
/* timing.h - how long work takes: processor time of this process, contestants in turn, the median of some rounds. */
#ifndef TRADEOFF_TIMING_H
#define TRADEOFF_TIMING_H

#include <stddef.h>

enum { CONTESTANTS_AT_MOST = 96, ROUNDS_AT_MOST = 32 };

/* Do the work of one contestant once. */
typedef void timed_work(void *contestant);

/* ns[i] receives the nanoseconds of contestant i, of `size` bytes each. */
void time_in_turn(timed_work *work, void *contestants, size_t size, size_t count, int rounds, double *ns);

/* spread[i] also receives the spread of contestant i: the range of the middle half of its rounds / the median. */
void time_with_spread(timed_work *work, void *contestants, size_t size, size_t count, int rounds, double *ns,
                      double *spread);

#endif
