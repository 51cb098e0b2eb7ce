/* SPDX-License-Identifier: MIT */
/* visits.c - the trees whose callbacks a thread is running. See visits.h. */
#include "visits.h"

THREAD_LOCAL visits visits_of_thread;

bool is_tree_in_callback_list(const octree *tree)
{
    unsigned i = 0;
    if (visits_of_thread.depth > VISITS_AT_MOST)
        return true;
    while (i < visits_of_thread.depth && visits_of_thread.trees[i] != tree)
        i++;
    return i < visits_of_thread.depth;
}
