/* hashed_leaf.h - the points of a leaf that holds more than the pool's largest block: an array with a hash table.
 *
 * A block is referred to by its array of points; a header lies before them, and the table after them.
 */
#ifndef OCTREE_HASHED_LEAF_H
#define OCTREE_HASHED_LEAF_H

#include "pool.h"

/* An empty array with room for `room` points. Null when there is no memory or room is beyond 2^31. */
octree_point *hashed_leaf_create(arena *memory, uint32_t room);
void hashed_leaf_release(arena *memory, octree_point *points);

uint32_t hashed_leaf_room(const octree_point *points);

/* The index of the pair (position, id), or UINT32_MAX. */
uint32_t hashed_leaf_find(const octree_point *points, const double position[3], uint64_t id);

/* Write a point at index `count`, for which there must be room, unless its pair is stored. Returns the pair's index. */
uint32_t hashed_leaf_append(octree_point *points, uint32_t count, const octree_point *point);

/* Remove the point at an index of `count`; the last point moves into its place. */
void hashed_leaf_remove(octree_point *points, uint32_t count, uint32_t index);

/* Overwrite the point at an index. */
void hashed_leaf_replace(octree_point *points, uint32_t index, const octree_point *point);

#endif
