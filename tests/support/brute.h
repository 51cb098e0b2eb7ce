/* SPDX-License-Identifier: MIT */
/* brute.h - an array of points that answers queries by linear scan: the oracle for tests of the tree. */
#ifndef BRUTE_H
#define BRUTE_H

#include "octree/octree.h"
#include "octree/sample.h"

typedef struct brute {
    octree_point *points;
    size_t count;
    size_t capacity;
} brute;

/* An empty array is {0}. */
void brute_free(brute *all);

/* Add a point, even if the pair (position, id) is already stored. */
void brute_insert(brute *all, const double position[3], uint64_t id);

/* Add `count` points with whole coordinates in [-reach, reach] and ids below `ids`; stored pairs are not added again.
 */
void brute_scatter(brute *all, uint64_t *random, size_t count, uint64_t reach, uint64_t ids);

/* Add `count` points of a distribution within a box, numbered from 0. */
void brute_sample(brute *all, octree_sample_kind kind, uint64_t seed, const octree_box *box, size_t count);

/* Returns a new tree under OCTREE_GROW with the same points; no pair (position, id) may occur twice. */
octree *brute_tree(const brute *all, octree_box world, size_t capacity, size_t depth);

/* Remove a pair (position, id). False if the pair is not stored. The order of the other points changes. */
bool brute_remove(brute *all, const double position[3], uint64_t id);

bool brute_contains(const brute *all, const double position[3], uint64_t id);

/* Find the lowest id at exactly these coordinates. False if no point is there. */
bool brute_find(const brute *all, const double position[3], uint64_t *id);

/* Add the points in a closed box to `found`. */
void brute_range(const brute *all, const octree_box *box, brute *found);

/* Whether |p - center| <= size in real numbers, on one axis. */
bool brute_is_within(double center, double size, double p);

/* Add the points within `size` of the centre on each axis to `found`, without the pair `self` (may be null). */
void brute_collide(const brute *all, const double center[3], double size, const octree_point *self, brute *found);

/* Whether a box that moves from `from` to `to` touches a point that moves from p to q in the same time. Correct if
 * products of the coordinates are exact, as with small whole numbers. */
bool brute_touches(const double from[3], const double to[3], double size, const double p[3], const double q[3]);

/* The same with a size for each axis: whether the box touches a box, if `sizes` are the sums of their half extents. */
bool brute_touches_box(const double from[3], const double to[3], const double sizes[3], const double p[3],
                       const double q[3]);

/* Whether a skip rule leaves this point out. */
bool brute_is_skipped(const octree_point *point, const double target[3], octree_skip skip, uint64_t skip_id);

/* The nearest point by squared distances in doubles, ties to the lowest id. Correct if the squares are exact, as with
 * small whole coordinates; exact_oracle.h is correct for all others. */
bool brute_nearest(const brute *all, const double target[3], octree_skip skip, uint64_t skip_id,
                   octree_neighbor *nearest);

/* Add the points at a distance of at most `radius` to `found`. Correct if the squares are exact. */
void brute_radius(const brute *all, const double center[3], double radius, brute *found);

/* The k nearest points by squared distance, then by id, then by position. Correct if the squares are exact. Returns
 * their number; the caller frees *nearest. */
size_t brute_nearest_k(const brute *all, const double target[3], size_t k, octree_skip skip, uint64_t skip_id,
                       octree_neighbor **nearest);

/* An octree_point_visitor that adds to the brute in `context`. */
bool brute_collect(const octree_point *point, void *context);

/* Whether both hold the same pairs. Sorts both. */
bool brute_equal(brute *a, brute *b);

#endif
