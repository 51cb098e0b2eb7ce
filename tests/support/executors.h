/* SPDX-License-Identifier: MIT */
/* executors.h - executors for tests: a shuffled order on the calling thread, or on threads. */
#ifndef EXECUTORS_H
#define EXECUTORS_H

#include "octree/octree.h"

/* Tasks one after the other, in another random order each time. */
octree_executor shuffled_executor(void);

/* Threads that are started for each run, which take tasks in a random order. The context is the executor's. */
typedef struct test_threads {
    unsigned count;  /* of threads, at most 8 */
    uint64_t random; /* state */
    size_t left_out; /* of every so many tasks one is not run; 0: none */
    bool odd_mode;   /* every second thread flushes subnormals to zero, where it can */
    size_t runs;     /* how often it was asked */
} test_threads;
octree_executor threads_executor(test_threads *threads);

#endif
