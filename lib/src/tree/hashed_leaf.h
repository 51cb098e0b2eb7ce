/* crowd.h - a leaf of more points than the pool's largest block: points in an array, found by a hash table.
 *
 * A crowd is named by its points; its header lies before them and its table behind.
 */
#ifndef OCTREE_CROWD_H
#define OCTREE_CROWD_H

#include "pool.h"

/* Room for at least `room` points, none of them there yet. Null when there is no memory or room is beyond 2^31. */
octree_point *crowd_create(arena *memory, uint32_t room);
void crowd_release(arena *memory, octree_point *crowd);

uint32_t crowd_room(const octree_point *crowd);

/* The index of the pair (position, id), or UINT32_MAX. */
uint32_t crowd_find(const octree_point *crowd, const double position[3], uint64_t id);

/* Put a point at index `count`; there must be room. */
void crowd_append(octree_point *crowd, uint32_t count, const octree_point *point);

/* Take out the point at an index of `count`; the last one takes its place. */
void crowd_take(octree_point *crowd, uint32_t count, uint32_t index);

/* Overwrite the point at an index. */
void crowd_replace(octree_point *crowd, uint32_t index, const octree_point *point);

#endif
