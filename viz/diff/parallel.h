/* SPDX-License-Identifier: MIT */
/* parallel.h - independent pieces of work on all cores. */
#ifndef DIFF_PARALLEL_H
#define DIFF_PARALLEL_H

#include <stddef.h>

/* Does the i-th piece. Pieces run at the same time, in any order. */
typedef void parallel_task(size_t i, void *context);

/* Do `count` pieces and return when all are done. The calling thread works too, so that all is done even where no
 * other thread can be started. */
void parallel_for(size_t count, parallel_task *task, void *context);

#endif
