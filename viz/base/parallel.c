/* SPDX-License-Identifier: MIT */
/* parallel.c - runs tasks on several threads. */
#include "parallel.h"
#include "cores.h"

#include <pthread.h>
#include <stdatomic.h>

enum { MOST_THREADS = 64 };

/* The work that all threads share. Each thread takes the next task until no task is left. */
typedef struct work {
    atomic_size_t next;
    size_t count;
    parallel_task *task;
    void *context;
} work;

static void *run_worker(void *shared)
{
    work *w = shared;
    for (size_t i; (i = atomic_fetch_add(&w->next, 1)) < w->count;)
        w->task(i, w->context);
    return NULL;
}

void parallel_for(size_t count, parallel_task *task, void *context)
{
    work w = {.count = count, .task = task, .context = context};
    pthread_t threads[MOST_THREADS];
    const unsigned workers = count_cores();
    size_t started = 0;
    while (started < MOST_THREADS && started + 1 < workers && started + 1 < count &&
           pthread_create(&threads[started], NULL, run_worker, &w) == 0)
        started++;
    run_worker(&w);
    for (size_t i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
}

void parallel_run(parallel_task *task, size_t count, void *task_context, void *unused)
{
    (void)unused;
    parallel_for(count, task, task_context);
}
