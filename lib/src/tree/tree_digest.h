/* tree_digest.h - the parts of octree_digest(). They are summed, so that the order in which nodes and points are met
 * does not count, and what is known of one part of a tree stays true while others change. Private.
 */
#ifndef OCTREE_TREE_DIGEST_H
#define OCTREE_TREE_DIGEST_H

#include "octree/digest.h"
#include "tree.h"

/* What a node adds to the sum, and of a leaf its points. */
uint64_t digest_node(const node *n, octree_address address);

/* The digest of a tree whose nodes have this sum. */
uint64_t digest_of_sum(const octree *tree, uint64_t sum);

#endif
