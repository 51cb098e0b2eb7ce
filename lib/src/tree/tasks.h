/* SPDX-License-Identifier: MIT */
/* tasks.h - large work divided into tasks, which the executor of a tree's definition runs on its threads.
 *
 * Work is divided by the number of points alone, so that memory does not depend on how many threads there are.
 */
#ifndef OCTREE_TASKS_H
#define OCTREE_TASKS_H

#include "tree.h"

enum { TASKS_AT_MOST = 64 };

/* How many tasks so many points are worth; 1 without an executor. */
unsigned tasks_for(const octree *tree, size_t points);

/* Run a task for each number below `count`. One that the executor leaves out, or calls on a thread whose floating-point
 * mode is not the default, runs on the calling thread at the end. */
void tasks_run(const octree *tree, octree_task *task, unsigned count, void *context);

/* Where the share of a task begins when so many things are divided among `tasks`; its end is where the next begins. */
static inline size_t tasks_share(size_t things, unsigned tasks, size_t number)
{
    const size_t more = things % tasks;
    return things / tasks * number + (number < more ? number : more);
}

/* A node and all below it, of a tree divided into some. */
typedef struct subtree {
    const node *node;
    octree_address address;
    cell cell;
    size_t before; /* points in earlier ones */
} subtree;

enum { SUBTREES_AT_MOST = 8 * TASKS_AT_MOST };

/* Told each node that is divided. False: it is left whole. */
typedef bool subtree_opener(const subtree *divided, void *context);

/* Divide a tree into subtrees of about so many tasks' shares, in Morton order. Returns how many there are. */
size_t subtrees_of(const octree *tree, unsigned tasks, subtree_opener *open, void *context,
                   subtree subtrees[SUBTREES_AT_MOST]);

/* Where the subtrees of a task begin; those of the next begin at its end. */
size_t subtrees_share(const octree *tree, const subtree *subtrees, size_t count, unsigned tasks, size_t number);

#endif
