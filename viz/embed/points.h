/* SPDX-License-Identifier: MIT */
/* points.h - the points of a program: those of its tree or list, sorted by id, and a table of them that changes.
 * Private to this folder. */
#ifndef EMBED_POINTS_H
#define EMBED_POINTS_H

#include "octreel/recorder.h"

/* By ascending id, each once. A zeroed one is empty. */
typedef struct points {
    octree_point *items;
    size_t count, room;
} points;

void points_release(points *p);

/* Make room for so many. False when there is no memory. */
bool points_reserve(points *p, size_t count);

void points_swap(points *a, points *b);

/* Read a tree, null being one without points; `spare` is used meanwhile. *clash is the id that is too large or there
 * twice. Errors: BAD_ID, DUPLICATE_ID, FLOAT_MODE, NO_MEMORY. Cost: O(nodes + n): ids are sorted by their digits. */
octreel_status points_read(points *p, points *spare, const octree *tree, uint64_t *clash);

/* The same of a list. */
octreel_status points_read_list(points *p, points *spare, const octree_point *list, size_t count, uint64_t *clash);

/* Points that are found, put and taken out by id, each in O(1). A zeroed one is empty. */
typedef struct point_table {
    octree_point *slots; /* an id that is none: nothing is there */
    size_t count, size;  /* of the slots: 0 or a power of two */
} point_table;

void point_table_release(point_table *t);

/* Make room for so many. False when there is no memory. */
bool point_table_reserve(point_table *t, size_t count);

/* Null where there is none. */
const octree_point *point_table_find(const point_table *t, uint64_t id);

/* Put a point in, in place of the one with its id. There is room. */
void point_table_put(point_table *t, const octree_point *point);

/* Take a point out that is there. */
void point_table_remove(point_table *t, uint64_t id);

/* List them all; `spare` is used meanwhile. False when there is no memory. Cost: O(n). */
bool point_table_list(const point_table *t, points *p, points *spare);

#endif
