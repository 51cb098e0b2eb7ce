/* SPDX-License-Identifier: MIT */
/* threads.h - times the bulk operations of the octree with several threads: by the clock, and by the critical path. */
#ifndef BENCH_THREADS_H
#define BENCH_THREADS_H

#include "measure.h"

/* the greatest number of threads, and of different numbers of threads, in one table */
enum { BENCH_THREADS_AT_MOST = 64, BENCH_THREAD_COUNTS = 8 };

/* Print a table of the bulk operations on a workload, with one row for each operation and number of threads. threads[0]
 * is the baseline of the ratios. Returns false if memory or threads run out. */
bool measure_threads(const workload *w, const unsigned *threads, int count, int rounds, bool json);

#endif
