/* SPDX-License-Identifier: MIT */
/* walk.h - adds one node to the statistics or to the digest of a tree. */
#ifndef OCTREE_WALK_H
#define OCTREE_WALK_H

#include "octree/digest.h"
#include "tree.h"

/* Prefetch the memory blocks of the children of an inner node: their children or points. */
static inline void prefetch_below(const node *n)
{
    for (unsigned i = bits_count8(n->octants); i-- > 0;)
        prefetch_memory(children_of(n)[i].below);
}

/* Add one node to the statistics of a tree. */
void count_node(octree_stats *stats, const node *n, unsigned depth);

/* Returns the digest of one node. The digest of a leaf includes its points. The digest of a tree is computed from the
 * sum of the digests of its nodes. So the order of nodes and points does not matter, and the sum of an unchanged
 * subtree can be reused. */
uint64_t digest_node(const node *n, octree_address address);
uint64_t digest_of_tree(const octree *tree, uint64_t sum);

/* Returns the digest of a tree or set with this definition, from the sum of the digests of its contents. */
uint64_t digest_of_definition(const octree_def *def, uint64_t sum);

#endif
