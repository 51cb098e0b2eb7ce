/* remove.h - removal in two steps, so that a move can make sure of the second before it does the first. Private. */
#ifndef OCTREE_REMOVE_H
#define OCTREE_REMOVE_H

#include "tree.h"

/* Where a pair lies: its way from the root, and its index in the leaf. */
typedef struct found_point {
    path way;
    uint32_t index;
} found_point;

/* False when the pair is not in the tree. */
bool find_point(const octree *tree, const double position[3], uint64_t id, found_point *found);

/* Make the leaf that removing this point now would merge others into; an empty one when no node would merge. False when
 * there is no memory. */
bool reserve_merge(octree *tree, const found_point *found, node *room);

/* Remove the point. Cannot fail; uses the room up or gives it back. */
void remove_found(octree *tree, const found_point *found, node *room);

#endif
