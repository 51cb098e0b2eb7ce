/* SPDX-License-Identifier: MIT */
/* walk.h - what is added up over all nodes of a tree: its statistics and its digest. */
#ifndef OCTREE_WALK_H
#define OCTREE_WALK_H

#include "octree/digest.h"
#include "tree.h"

/* Start loading what is below each child of an inner node. */
static inline void prefetch_below(const node *n)
{
    for (unsigned i = bits_count8(n->octants); i-- > 0;)
        prefetch(children_of(n)[i].below);
}

/* Add one node to the statistics. */
void count_node(octree_stats *stats, const node *n, unsigned depth);

/* The digest of a tree is made of the sum of what each node adds, so that the order in which nodes and points are
 * visited does not count, and the sum of an unchanged subtree can be kept. A leaf adds its points too. */
uint64_t digest_node(const node *n, octree_address address);
uint64_t digest_of_sum(const octree *tree, uint64_t sum);

#endif
