/* SPDX-License-Identifier: MIT */
/* lookup.h - finds the row of a body. Private. */
#ifndef OCTREE_LOOKUP_H
#define OCTREE_LOOKUP_H

#include "set.h"

/* Returns the index of the row of a body, or ROW_NONE. */
uint32_t find_row(const octree_bodies *set, const octree_body *body);

/* Does the same before a change. If the body would be in a crowded leaf, the rows are hashed first, unless memory is
 * short. */
uint32_t find_row_for_change(octree_bodies *set, const octree_body *body);

/* Returns whether a leaf of the set is crowded, so that a body in it is found slowly without the hash table. Cost:
 * O(n / POOL_MAX_UNITS). */
bool has_crowded_leaf(const octree_bodies *set);

#endif
