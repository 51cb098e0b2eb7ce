/* SPDX-License-Identifier: MIT */
#include "executors.h"
#include "fixture.h"

#include <pthread.h>
#include <stdatomic.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

enum { TASKS_AT_MOST = 64, THREADS_AT_MOST = 8 };

static void shuffle(uint64_t *random, size_t order[TASKS_AT_MOST], size_t count)
{
    assert_true(count <= TASKS_AT_MOST);
    for (size_t i = 0; i < count; i++) {
        const size_t at = random_below(random, i + 1);
        order[i] = order[at];
        order[at] = i;
    }
}

static void run_shuffled(octree_task *task, size_t count, void *task_context, void *context)
{
    size_t order[TASKS_AT_MOST];
    shuffle(context, order, count);
    for (size_t i = 0; i < count; i++)
        task(order[i], task_context);
}

octree_executor shuffled_executor(void)
{
    static uint64_t random = 1;
    return (octree_executor){run_shuffled, &random};
}

typedef struct job {
    octree_task *task;
    void *context;
    const test_threads *threads;
    size_t order[TASKS_AT_MOST], count;
    atomic_size_t next;
} job;

static void take_tasks(job *j)
{
    for (size_t i; (i = atomic_fetch_add(&j->next, 1)) < j->count;)
        if (j->threads->left_out == 0 || i % j->threads->left_out > 0)
            j->task(j->order[i], j->context);
}

static void take_too_many_tasks(job *j)
{
    static const size_t beyond[] = {TASKS_AT_MOST, TASKS_AT_MOST + 1, SIZE_MAX / 2, SIZE_MAX};
    for (size_t i = 0; i < j->count; i++)
        j->task(j->order[i], j->context);
    for (size_t number = j->count; number < TASKS_AT_MOST; number++)
        j->task(number, j->context);
    for (size_t i = 0; i < sizeof beyond / sizeof beyond[0]; i++)
        j->task(beyond[i], j->context);
}

static void *take_tasks_plainly(void *context)
{
    job *j = context;
    (j->threads->careless ? take_too_many_tasks : take_tasks)(j);
    return NULL;
}

static void *take_tasks_oddly(void *context)
{
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040); /* subnormals are flushed to zero */
#endif
    return take_tasks_plainly(context);
}

static void run_on_threads(octree_task *task, size_t count, void *task_context, void *context)
{
    test_threads *threads = context;
    pthread_t started[THREADS_AT_MOST];
    job j = {.task = task, .context = task_context, .threads = threads, .count = count};
    assert_true(threads->count <= THREADS_AT_MOST);
    threads->runs++;
    shuffle(&threads->random, j.order, count);
    for (unsigned i = 0; i < threads->count; i++)
        assert_int_equal(
            pthread_create(&started[i], NULL, threads->odd_mode && i % 2 ? take_tasks_oddly : take_tasks_plainly, &j),
            0);
    for (unsigned i = 0; i < threads->count; i++)
        assert_int_equal(pthread_join(started[i], NULL), 0);
}

octree_executor threads_executor(test_threads *threads)
{
    return (octree_executor){run_on_threads, threads};
}
