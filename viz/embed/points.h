/* SPDX-License-Identifier: MIT */
/* points.h - stores a program's points as a list sorted by id, and as a hash table. Private to viz/embed. */
#ifndef EMBED_POINTS_H
#define EMBED_POINTS_H

#include "octreel/recorder.h"

/* A list of points in ascending order of their ids. Each id occurs once. A zero-initialized list is empty. */
typedef struct points {
    octree_point *items;
    size_t count, room;
} points;

void points_release(points *p);

void points_swap(points *a, points *b);

/* Read all points of a tree, or of a list if the tree is null. `spare` is scratch memory. On an error *clash is the id
 * that is too large or occurs twice. Errors: BAD_ID, DUPLICATE_ID, NO_MEMORY. Cost: O(nodes + n), because the ids are
 * sorted by a radix sort. */
octreel_status points_read(points *p, points *spare, const octree *tree, const octree_point *list, size_t count,
                           uint64_t *clash);

/* Read all bodies of a set, or of a list if the set is null: their positions into `p`, and the half extents of the
 * bodies that have any into `extents`. Errors and cost: those of points_read(). */
octreel_status points_read_bodies(points *p, points *extents, points *spare, const octree_bodies *set,
                                  const octree_body *list, size_t count, uint64_t *clash);

/* Returns whether a body with these half extents is more than a point. Returns true for invalid half extents. */
static inline bool has_extents(const double half[3])
{
    return half[0] != 0 || half[1] != 0 || half[2] != 0;
}

/* A hash table of points by id; each operation costs O(1) on average. A zero-initialized table is empty. */
typedef struct point_table {
    octree_point *slots; /* an empty slot has the id UINT64_MAX */
    size_t count, size;  /* number of points; number of slots, which is 0 or a power of two */
} point_table;

void point_table_release(point_table *t);

/* Make room for `count` points. Returns false if memory runs out. */
bool point_table_reserve(point_table *t, size_t count);

/* Returns the point with this id, or null if the table has none. */
const octree_point *point_table_find(const point_table *t, uint64_t id);

/* Insert a point. If the table has a point with the same id, replace that point. The table must have room. */
void point_table_set(point_table *t, const octree_point *point);

/* Remove the point with this id. The table must contain the point. */
void point_table_remove(point_table *t, uint64_t id);

/* Write all points of the table into the list `p`, sorted by id. `spare` is scratch memory. Returns false if memory
 * runs out. Cost: O(slots + points). */
bool point_table_list(const point_table *t, points *p, points *spare);

#endif
