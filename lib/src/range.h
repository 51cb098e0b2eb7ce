/* range.h - the descent that every box query shares. Private. */
#ifndef OCTREE_RANGE_H
#define OCTREE_RANGE_H

#include "tree.h"

/* Called with a node that meets the box. `inside`: all of its points are in the box. Inner nodes are entered when the
 * answer is true. */
typedef bool (*range_node)(const node *n, bool inside, void *context);

/* OK, NULL_ARGUMENT, NOT_FINITE or BAD_RANGE. Stops when a leaf's answer is false. */
octree_status range_descend(const octree *tree, const octree_box *box, range_node visit, void *context);

#endif
