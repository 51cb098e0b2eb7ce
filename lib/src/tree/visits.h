/* SPDX-License-Identifier: MIT */
/* visits.h - refuses changes of a tree inside its own callbacks. Private.
 *
 * Problem: if a visitor, a tracer or an executor changes the tree, it frees nodes or log entries that the function
 * which called it still reads.
 *
 * Idea: each thread lists the trees whose callbacks it is running. Every public function that changes a tree looks for
 * this tree in the list of its thread, and returns OCTREE_BUSY if the tree is in the list. A change on another thread
 * during a visit is not detected: the caller must ensure that a change of a tree runs alone.
 *
 * Why not a counter in the tree: queries take a const tree and run on many threads, which would compete for the
 * counter's cache line at every query. Threads do not share lists, so the lists need no atomics.
 *
 * Cost: a walk, a query of a region or a traced search writes three words of thread-local memory (15 instructions); a
 * change of a tree reads one word. Other queries pay nothing.
 */
#ifndef OCTREE_VISITS_H
#define OCTREE_VISITS_H

#include "octree/types.h"

/* The thread-local storage model "initial-exec": with glibc, such variables are read without a function call, in the
 * shared library too. glibc reserves space for them. */
#if defined(__GLIBC__) && defined(__GNUC__)
#define THREAD_LOCAL _Thread_local __attribute__((tls_model("initial-exec")))
#else
#define THREAD_LOCAL _Thread_local
#endif

/* The length of the list: the maximum number of nested visits. During a deeper visit, every tree counts as a tree whose
 * callbacks are running. */
enum { VISITS_AT_MOST = 15 };

typedef struct visits {
    /* the tree of each nested visit: visits are nested when a visitor queries the same tree or another tree */
    const octree *trees[VISITS_AT_MOST];
    unsigned depth;
} visits;

extern THREAD_LOCAL visits visits_of_thread;

/* Add the tree to this thread's list. Must be called before the tree's callbacks are called. Returns the argument for
 * end_callbacks(), which removes the tree from the list. */
static inline unsigned begin_callbacks(const octree *tree)
{
    const unsigned depth = visits_of_thread.depth;
    if (depth < VISITS_AT_MOST)
        visits_of_thread.trees[depth] = tree;
    visits_of_thread.depth = depth + 1;
    return depth;
}

static inline void end_callbacks(unsigned begun)
{
    visits_of_thread.depth = begun;
}

bool is_tree_in_callback_list(const octree *tree);

/* Returns whether this thread is running a callback of the tree. */
static inline bool is_running_callback(const octree *tree)
{
    return visits_of_thread.depth > 0 && is_tree_in_callback_list(tree);
}

#endif
