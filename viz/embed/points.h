/* SPDX-License-Identifier: MIT */
/* points.h - the points of a tree, read and sorted by id. Private to this folder. */
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

#endif
