/* SPDX-License-Identifier: MIT */
/* lookup.h - finds the row of a body. Private. */
#ifndef OCTREE_LOOKUP_H
#define OCTREE_LOOKUP_H

#include "set.h"

/* Where a body is stored, or would be. */
typedef struct found_body {
    unsigned level; /* of its half extents */
    uint32_t row;   /* ROW_NONE: the body is not stored */
    uint64_t code;  /* the Morton code of its position */
    found_point at; /* in the tree of its level; the index is set only if the body is stored */
} found_body;

/* Find a body. Returns whether it is stored. If its level has no tree, only the level and the row are set. */
bool find_body(const octree_bodies *set, const octree_body *body, found_body *found);

/* Does the same before a change. If the body would be in a crowded leaf, the rows are hashed first, unless memory is
 * short. `near` is null, or the result for another body of this set, which has not changed since. The search begins
 * with the nodes that both paths share. */
bool find_body_for_change(octree_bodies *set, const octree_body *body, const found_body *near, found_body *found);

/* Returns whether a leaf of the set is crowded, so that a body in it is found slowly without the hash table. Cost:
 * O(n / POOL_MAX_UNITS). */
bool has_crowded_leaf(const octree_bodies *set);

#endif
