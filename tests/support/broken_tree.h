/* SPDX-License-Identifier: MIT */
/* broken_tree.h - a tree that breaks an invariant: no call of the library can make one. */
#ifndef BROKEN_TREE_H
#define BROKEN_TREE_H

#include "octree/octree.h"

/* Write another place into the point that the tree stores at a position, behind its back. Its leaf's address; the
 * validator finds it there when the place is not in that leaf. */
octree_address break_tree(const octree *tree, const double position[3], const double place[3]);

#endif
