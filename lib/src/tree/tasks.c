/* SPDX-License-Identifier: MIT */
/* tasks.c - divides work into tasks, and trees into subtrees. See tasks.h. */
#include "tasks.h"
#include "../exact/float_mode.h"

#include <stdatomic.h>
#include <string.h>

#ifndef OCTREE_LEAST_SHARE
#define OCTREE_LEAST_SHARE 1024 /* the minimum number of points for each task */
#endif

unsigned count_tasks(const octree *tree, size_t points)
{
    const size_t tasks = tree->def.executor.run ? points / OCTREE_LEAST_SHARE : 0;
    return tasks < 1 ? 1 : tasks < TASKS_AT_MOST ? (unsigned)tasks : TASKS_AT_MOST;
}

typedef struct tasks {
    octree_task *task;
    void *context;
    unsigned count;
    /* started[i] is set when task i starts, because an executor that calls a number twice must not run the task
     * twice */
    atomic_bool started[TASKS_AT_MOST];
} tasks;

/* Run one task in the default floating-point mode, because a thread of the executor may have any mode. The task is
 * called through a pointer, so that the compiler cannot move the task's arithmetic out of the call. */
static void run_task(size_t number, void *context)
{
    tasks *all = context;
    const bool enters = !float_mode_is_default();
    if (number >= all->count || atomic_exchange_explicit(&all->started[number], true, memory_order_relaxed))
        return;
    if (enters)
        float_mode_enter();
    all->task(number, all->context);
    if (enters)
        float_mode_leave();
}

/* Call the executor in the caller's floating-point mode, like all functions of the caller. */
static void call_executor(const octree_executor *executor, size_t count, tasks *all)
{
    const bool paused = float_mode_pause();
    executor->run(run_task, count, all, executor->context);
    float_mode_resume(paused);
}

void run_tasks(const octree *tree, octree_task *task, unsigned count, void *context)
{
    const octree_executor *executor = &tree->def.executor;
    tasks all = {.task = task, .context = context, .count = count};
    for (unsigned number = 0; number < count; number++)
        atomic_init(&all.started[number], false);
    const unsigned begun = begin_callbacks(tree);
    if (executor->run && count > 1)
        call_executor(executor, count, &all);
    for (unsigned number = 0; number < count; number++)
        if (!atomic_load_explicit(&all.started[number], memory_order_relaxed))
            task(number, context);
    end_callbacks(begun);
}

/* Replace a subtree in the list by the subtrees of its children. */
static void divide_subtree(forest *f, size_t at)
{
    const subtree whole = f->subtrees[at];
    const unsigned children = bits_count8(whole.node->octants);
    subtree *part = &f->subtrees[at];
    memmove(part + children, part + 1, (f->count - at - 1) * sizeof *part);
    const node *child = children_of(whole.node);
    size_t before = whole.before;
    for (unsigned octant = 0; octant < 8; octant++)
        if (whole.node->octants >> octant & 1) {
            *part++ = (subtree){child, whole.address << 3 | octant, cell_child(whole.cell, octant), before};
            before += child++->count;
        }
    f->count += children - 1;
}

void divide_tree(forest *f, const octree *tree, subtree_opener *open, void *context)
{
    f->tree = tree;
    f->tasks = count_tasks(tree, tree->root.count);
    f->count = 1;
    f->subtrees[0] = (subtree){&tree->root, OCTREE_ROOT, root_cell(), 0};
    const size_t share = f->tasks == 1 ? SIZE_MAX : tree->root.count / f->tasks / 2 + 1;
    for (size_t at = 0; at < f->count;) {
        const bool fits = f->count + 7 <= SUBTREES_AT_MOST;
        const subtree *s = &f->subtrees[at];
        if (s->node->octants && s->node->count > share && fits && (!open || open(s, context)))
            divide_subtree(f, at);
        else
            at++;
    }
}

const subtree *first_subtree(const forest *f, size_t number)
{
    if (number == f->tasks)
        return f->subtrees + f->count; /* also in an empty tree, whose root is at the start of all shares */
    const size_t before = find_share_start(f->tree->root.count, f->tasks, number);
    const subtree *first = f->subtrees;
    while (first < f->subtrees + f->count && first->before < before)
        first++;
    return first;
}
