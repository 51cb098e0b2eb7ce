/* SPDX-License-Identifier: MIT */
/* points.h - a program's points as a list sorted by id, and as a hash table. Private to this folder. */
#ifndef EMBED_POINTS_H
#define EMBED_POINTS_H

#include "octreel/recorder.h"

/* Points in ascending order of ids, which are unique. Zero-initialized points are empty. */
typedef struct points {
    octree_point *items;
    size_t count, room;
} points;

void points_release(points *p);

void points_swap(points *a, points *b);

/* Read all points of a tree or, where it is null, of a list. `spare` is scratch. On an error *clash is the id that is
 * too large or occurs twice. Errors: BAD_ID, DUPLICATE_ID, NO_MEMORY. Cost: O(nodes + n), by a radix sort
 * of ids. */
octreel_status points_read(points *p, points *spare, const octree *tree, const octree_point *list, size_t count,
                           uint64_t *clash);

/* A hash table of points by id; each operation costs O(1) on average. A zero-initialized table is empty. */
typedef struct point_table {
    octree_point *slots; /* an empty slot has the id UINT64_MAX */
    size_t count, size;  /* points; slots, 0 or a power of two */
} point_table;

void point_table_release(point_table *t);

/* Make room for `count` points. False if out of memory. */
bool point_table_reserve(point_table *t, size_t count);

/* The point with an id, or null. */
const octree_point *point_table_find(const point_table *t, uint64_t id);

/* Insert a point, or replace the point with its id. The table has room. */
void point_table_put(point_table *t, const octree_point *point);

/* Remove a point, which must exist. */
void point_table_remove(point_table *t, uint64_t id);

/* List all points sorted by id; `spare` is scratch. False if out of memory. Cost: O(slots + points). */
bool point_table_list(const point_table *t, points *p, points *spare);

#endif
