/* rebuild.h - the same points in a tree of another definition. Private. */
#ifndef OCTREE_REBUILD_H
#define OCTREE_REBUILD_H

#include "tree.h"

/* Errors: those of octree_create, OUTSIDE, FULL, NO_MEMORY; the tree is then unchanged. */
octree_status rebuild(octree *tree, const octree_def *def);

#endif
