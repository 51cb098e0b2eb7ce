/* SPDX-License-Identifier: MIT */
/* packed_points.h - packs the points of a page into a block (point_block.h), and compresses the block as gzip does. */
#ifndef RECORD_PACKED_POINTS_H
#define RECORD_PACKED_POINTS_H

#include "point_block.h"

/* A page with fewer points has them in its session.json, which people can read. */
#define PACKED_FEWEST 10000

/* Pack a block. Returns the packed bytes, which the caller frees; *packed becomes their number. Returns null if memory
 * runs out. Cost: O(points). */
unsigned char *pack_points(const point_block *b, size_t *packed);

/* Returns whether the page of a session has the points in a block: there are PACKED_FEWEST to POINT_BLOCK_MOST points
 * with ascending ids, none of them is the player, and the session does not have both edits and values. `values` may be
 * null. */
bool are_points_packed(const octree_session *session, const point_values *values);

/* Pack the points of a session for which are_points_packed() is true. The caller frees the result. Returns null if
 * memory runs out. */
unsigned char *pack_points_of_session(const octree_session *session, const point_values *values, size_t *packed);

#endif
