/* SPDX-License-Identifier: MIT */
/* tasks.h - divides large work into tasks for the executor of a tree.
 *
 * The division depends on the number of points only. So the memory use does not depend on the number of threads.
 */
#ifndef OCTREE_TASKS_H
#define OCTREE_TASKS_H

#include "tree.h"

enum { TASKS_AT_MOST = 64 };

/* The number of tasks into which work on this many points is divided; 1 without an executor. */
unsigned count_tasks(const octree *tree, size_t points);

/* Run a task once for each number below `count`, which is at most TASKS_AT_MOST. The task runs in the default
 * floating-point mode on every thread. If the executor leaves out a number, the task for it runs on the calling thread
 * at the end. */
void run_tasks(const octree *tree, octree_task *task, unsigned count, void *context);

/* Divide `things` items among tasks: return the index of the first item of task `number`. Its items end where those of
 * the next task begin. */
static inline size_t share_start(size_t things, unsigned tasks, size_t number)
{
    const size_t more = things % tasks;
    return things / tasks * number + (number < more ? number : more);
}

/* A node and everything below it. */
typedef struct subtree {
    const node *node;
    octree_address address;
    cell cell;
    size_t before; /* the number of points in earlier subtrees */
} subtree;

enum { SUBTREES_AT_MOST = 8 * TASKS_AT_MOST };

/* A tree divided into subtrees in Morton order. A subtree has about half the points that a task works on. */
typedef struct forest {
    const octree *tree;
    unsigned tasks;
    size_t count;
    subtree subtrees[SUBTREES_AT_MOST];
} forest;

/* Called with each node before the node is divided into its children. Returns false to keep the node undivided. */
typedef bool subtree_opener(const subtree *divided, void *context);

/* Divide a tree into subtrees for the tasks. The number of tasks depends on the number of points. `open` may be
 * null. */
void divide_tree(forest *f, const octree *tree, subtree_opener *open, void *context);

/* The first subtree of a task. The task's subtrees end at the first subtree of the next task. */
const subtree *first_subtree(const forest *f, size_t number);

#endif
