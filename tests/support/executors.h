/* SPDX-License-Identifier: MIT */
/* executors.h - executors for tests: they run tasks in a random order, on the calling thread or on several threads. */
#ifndef EXECUTORS_H
#define EXECUTORS_H

#include "octree/octree.h"

/* Returns an executor that runs the tasks on the calling thread, each time in a new random order. */
octree_executor shuffled_executor(void);

/* Runs the tasks in a random order on threads that are started for each run. The structure is the executor's context.
 */
typedef struct test_threads {
    unsigned count;  /* number of threads, at most 8 */
    uint64_t random; /* state of the random numbers */
    size_t left_out; /* leave out one task in this number of tasks; 0: run all tasks */
    bool careless;   /* true: every thread runs every task, and task numbers beyond the last */
    bool odd_mode;   /* true: every second thread flushes subnormals to zero, if the processor can */
    size_t runs;     /* number of runs */
} test_threads;
octree_executor threads_executor(test_threads *threads);

#endif
