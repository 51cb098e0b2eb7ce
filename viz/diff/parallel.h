/* parallel.h - independent pieces of work on all cores. */
#ifndef DIFF_PARALLEL_H
#define DIFF_PARALLEL_H

#include <stddef.h>

/* Does the i-th piece. Pieces run at the same time, in any order. */
typedef void parallel_task(size_t i, void *context);

/* Do `count` pieces, at most `workers` of them at a time; back when all are done. The caller's thread works too, so
 * that what cannot be started in a thread of its own is done all the same. */
void parallel_for(size_t count, unsigned workers, parallel_task *task, void *context);

#endif
