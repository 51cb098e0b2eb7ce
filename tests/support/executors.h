/* SPDX-License-Identifier: MIT */
/* executors.h - executors for tests: they run tasks in a random order, on the calling thread or on several threads. */
#ifndef EXECUTORS_H
#define EXECUTORS_H

#include "octree/octree.h"

/* Runs the tasks on the calling thread, in a new random order each time. */
octree_executor shuffled_executor(void);

/* Runs the tasks in a random order on threads that are started for each run. The structure is the executor's context.
 */
typedef struct test_threads {
    unsigned count;  /* of threads, at most 8 */
    uint64_t random; /* state */
    size_t left_out; /* skip one task in this number; 0: run all */
    bool careless;   /* every thread runs every task, and numbers that are too large */
    bool odd_mode;   /* every second thread flushes subnormals to zero, if the processor can */
    size_t runs;     /* number of runs */
} test_threads;
octree_executor threads_executor(test_threads *threads);

#endif
