/* insert.h - insertion for those who have checked the position. Private. */
#ifndef OCTREE_INSERT_H
#define OCTREE_INSERT_H

#include "tree.h"

/* DUPLICATE, FULL, NO_MEMORY, TOO_MANY or OK. */
octree_status insert_point(octree *tree, const octree_point *point);

#endif
