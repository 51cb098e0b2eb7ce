/* SPDX-License-Identifier: MIT */
/* parallel.h - runs independent tasks on all cores. */
#ifndef BASE_PARALLEL_H
#define BASE_PARALLEL_H

#include <stddef.h>

/* Performs task i. Tasks run concurrently and in any order. */
typedef void parallel_task(size_t i, void *context);

/* Runs tasks 0 to count - 1 and returns when all tasks are done. The calling thread also runs tasks, so all tasks are
 * done even if no other thread can be started. */
void parallel_for(size_t count, parallel_task *task, void *context);

/* Calls parallel_for(), with the parameters in the order of octree_executor.run. `unused` is ignored. */
void parallel_run(parallel_task *task, size_t count, void *task_context, void *unused);

#endif
