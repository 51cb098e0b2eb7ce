/* SPDX-License-Identifier: MIT */
/* division.c - the tasks of a large batch: their memory pools, and how they start. See division.h. */
#include "division.h"

#include <string.h>

void divide_work_of_batch(batch *b)
{
    const unsigned tasks = count_tasks(b->tree, b->count);
    b->division = tasks > 1 ? arena_allocate(&b->store->memory, sizeof *b->division) : NULL;
    if (!b->division)
        return;
    memset(b->division, 0, sizeof *b->division);
    b->division->tasks = tasks;
    b->division->grain = b->count / tasks / 2 + 1;
}

void release_work_division(batch *b)
{
    arena_free(&b->store->memory, b->division, sizeof *b->division);
    b->division = NULL;
}

void create_part_pools(batch *b, size_t expected)
{
    division *d = b->division;
    store *whole = &b->tree->store;
    if (!d)
        return;
    pool_prepare_lending(&whole->nodes);
    pool_prepare_lending(&whole->points);
    for (unsigned i = 0; i < d->tasks; i++) {
        store *own = &d->parts[i].store;
        d->parts[i].batch = (batch){.store = own};
        own->memory = (arena){.allocator = whole->memory.allocator, .shared = &whole->memory};
        pool_init_borrowing(&own->nodes, &own->memory, &whole->nodes, expected / d->tasks / 16);
        pool_init_borrowing(&own->points, &own->memory, &whole->points, expected / d->tasks);
    }
}

void join_part_pools(batch *b)
{
    division *d = b->division;
    for (unsigned i = 0; d && i < d->tasks; i++) {
        pool_join(&b->tree->store.nodes, &d->parts[i].store.nodes);
        pool_join(&b->tree->store.points, &d->parts[i].store.points);
    }
}

void run_task_for_each_part(batch *b, octree_task *task)
{
    division *d = b->division;
    for (unsigned i = 0; i < d->tasks; i++) {
        batch *own = &d->parts[i].batch;
        const batch before = *own;
        *own = *b;
        own->division = NULL;
        own->store = &d->parts[i].store;
        own->patches = before.patches;
        own->edits = before.edits;
        own->duplicate = before.duplicate;
        own->overflow = before.overflow;
    }
    run_tasks(b->tree, task, d->tasks, d);
}

bool add_job(batch *b, const node *old, cell c, span leaving, span arriving)
{
    const job j = {.old = old, .cell = c, .leaving = leaving, .arriving = arriving};
    return list_push(&b->store->memory, &b->division->work.jobs, &j, sizeof j);
}

void assign_jobs_to_tasks(division *d)
{
    const job *jobs = d->work.jobs.items;
    const size_t count = d->work.jobs.count;
    size_t total = 0, sum = 0, next = 0;
    for (size_t i = 0; i < count; i++)
        total += jobs[i].leaving.count + jobs[i].arriving.count;
    for (unsigned task = 0; task < d->tasks; task++) {
        d->starts[task] = next;
        for (; next < count && sum < find_share_start(total, d->tasks, task + 1); next++)
            sum += jobs[next].leaving.count + jobs[next].arriving.count;
    }
    d->starts[d->tasks] = count;
}
