/* SPDX-License-Identifier: MIT */
/* broken_tree.h - makes a tree that violates an invariant, which no call of the library can do. */
#ifndef BROKEN_TREE_H
#define BROKEN_TREE_H

#include "octree/octree.h"

/* Overwrite the position of a stored point without the tree's knowledge. Returns the address of its leaf, where
 * octree_check() finds the violation if the new position is outside the leaf. */
octree_address break_tree(const octree *tree, const double position[3], const double place[3]);

#endif
