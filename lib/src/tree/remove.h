/* remove.h - removal in two steps, so that a move can make sure of it before it changes anything. */
#ifndef OCTREE_REMOVE_H
#define OCTREE_REMOVE_H

#include "tree.h"

/* Make the leaf that removing this point now would merge nodes into, empty when none would merge. False when there is
 * no memory. */
bool reserve_merge(octree *tree, const found_point *found, node *spare);

/* Remove the point. Cannot fail; uses or frees the spare leaf. */
void remove_found(octree *tree, const found_point *found, node *spare);

#endif
