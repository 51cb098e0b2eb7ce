/* SPDX-License-Identifier: MIT */
/* parallel.h - independent pieces of work on all cores. */
#ifndef BASE_PARALLEL_H
#define BASE_PARALLEL_H

#include <stddef.h>

/* Does the i-th piece. Pieces run at the same time, in any order. */
typedef void parallel_task(size_t i, void *context);

/* Do `count` pieces and return when all are done. The calling thread works too, so that all is done even where no
 * other thread can be started. */
void parallel_for(size_t count, parallel_task *task, void *context);

/* The same, as the executor of an octree takes it. */
void parallel_run(parallel_task *task, size_t count, void *task_context, void *unused);

#endif
