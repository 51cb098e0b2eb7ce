/* SPDX-License-Identifier: MIT */
/* tasks.h - divides large work into tasks for the executor of a tree.
 *
 * The division depends on the number of points only, so that memory does not depend on the number of threads.
 */
#ifndef OCTREE_TASKS_H
#define OCTREE_TASKS_H

#include "tree.h"

enum { TASKS_AT_MOST = 64 };

/* The number of tasks for work on this many points; 1 without an executor. */
unsigned count_tasks(const octree *tree, size_t points);

/* Run a task once for each number below `count`, at most TASKS_AT_MOST, in the default floating-point mode on every
 * thread. A task that the executor does not run runs on the calling thread at the end. */
void run_tasks(const octree *tree, octree_task *task, unsigned count, void *context);

/* The index of the first of `things` in the share of a task; the share ends where the next begins. */
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

/* A tree divided into subtrees of about half a task's share, in Morton order. */
typedef struct forest {
    const octree *tree;
    unsigned tasks;
    size_t count;
    subtree subtrees[SUBTREES_AT_MOST];
} forest;

/* Called with each node before it is divided. Returns false to leave the node whole. */
typedef bool subtree_opener(const subtree *divided, void *context);

/* Divide a tree among the tasks for its points. `open` may be null. */
void divide_tree(forest *f, const octree *tree, subtree_opener *open, void *context);

/* The first subtree of a task; its subtrees end where those of the next task begin. */
const subtree *first_subtree(const forest *f, size_t number);

#endif
