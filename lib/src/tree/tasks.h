/* SPDX-License-Identifier: MIT */
/* tasks.h - divides large work into tasks for the executor of a tree.
 *
 * The number of points alone determines the division, so that the memory use does not depend on the number of threads.
 */
#ifndef OCTREE_TASKS_H
#define OCTREE_TASKS_H

#include "tree.h"

enum { TASKS_AT_MOST = 64 };

/* Returns the number of tasks into which work on this many points is divided. Returns 1 without an executor. */
unsigned count_tasks(const octree *tree, size_t points);

/* Run a task once for each number below `count`, which is at most TASKS_AT_MOST. The task runs in the default
 * floating-point mode on every thread. If the executor omits a number, the task with this number runs on the calling
 * thread at the end. */
void run_tasks(const octree *tree, octree_task *task, unsigned count, void *context);

/* Divide this many items among tasks. Returns the index of the first item of the task with this number. The task's
 * items end where the items of the next task begin. */
static inline size_t find_share_start(size_t items, unsigned tasks, size_t number)
{
    const size_t more = items % tasks;
    return items / tasks * number + (number < more ? number : more);
}

/* A node and all nodes below it. */
typedef struct subtree {
    const node *node;
    octree_address address;
    cell cell;
    size_t before; /* the number of points in the subtrees before this one */
} subtree;

enum { SUBTREES_AT_MOST = 8 * TASKS_AT_MOST };

/* A tree divided into subtrees in Morton order. A subtree has about half as many points as a task works on. */
typedef struct forest {
    const octree *tree;
    unsigned tasks;
    size_t count;
    subtree subtrees[SUBTREES_AT_MOST];
} forest;

/* A function that is called with each node before the node is divided into its children. It returns false to keep the
 * node undivided. */
typedef bool subtree_opener(const subtree *divided, void *context);

/* Divide a tree into subtrees for the tasks. The number of points determines the number of tasks. `open` may be
 * null. */
void divide_tree(forest *f, const octree *tree, subtree_opener *open, void *context);

/* Returns the first subtree of a task. The task's subtrees end at the first subtree of the next task. */
const subtree *first_subtree(const forest *f, size_t number);

#endif
