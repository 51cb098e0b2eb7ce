/* SPDX-License-Identifier: MIT */
/* brute.h - a plain array of points that answers by linear scan: the oracle that cannot be wrong about structure.
 */
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

/* Add a point, pairs that are stored included. */
void brute_insert(brute *all, const double position[3], uint64_t id);

/* Add `count` points with whole coordinates in [-reach, reach] and ids below `ids`, but for pairs that are stored. */
void brute_scatter(brute *all, uint64_t *random, size_t count, uint64_t reach, uint64_t ids);

/* Add `count` points of a distribution within a box, numbered from 0. */
void brute_sample(brute *all, octree_sample_kind kind, uint64_t seed, const octree_box *box, size_t count);

/* A new tree under OCTREE_GROW with the same contents, which must be pairs that differ. */
octree *brute_tree(const brute *all, octree_box world, size_t capacity, size_t depth);

/* Take the pair out. False when it is not there. The order of the others changes. */
bool brute_remove(brute *all, const double position[3], uint64_t id);

bool brute_contains(const brute *all, const double position[3], uint64_t id);

/* The lowest id at exactly these coordinates. */
bool brute_find(const brute *all, const double position[3], uint64_t *id);

/* Add the points in a closed box to `found`. */
void brute_range(const brute *all, const octree_box *box, brute *found);

/* Whether |p - center| <= size in real numbers, on one axis. */
bool brute_within(double center, double size, double p);

/* Add the points within `size` of the centre on each axis, but for the pair `self` (may be null), to `found`. */
void brute_collide(const brute *all, const double center[3], double size, const octree_point *self, brute *found);

/* Whether a box of this size touches a point on its way from p to q, while it goes from one place to another: true
 * where products of the coordinates are exact, as for small whole ones. */
bool brute_touches(const double from[3], const double to[3], double size, const double p[3], const double q[3]);

/* Whether a skip rule leaves this point out. */
bool brute_skips(const octree_point *point, const double target[3], octree_skip skip, uint64_t skip_id);

/* The nearest point by plain squared distances, ties to the lowest id: true where those squares are exact, as for
 * small whole coordinates. exact_oracle.h has the truth for all others. */
bool brute_nearest(const brute *all, const double target[3], octree_skip skip, uint64_t skip_id,
                   octree_neighbor *nearest);

/* The points at a distance of at most `radius` from the centre, added to `found`; true where the squares are exact. */
void brute_radius(const brute *all, const double center[3], double radius, brute *found);

/* The k nearest points by plain squared distances, then by id, then by position; true where the squares are exact.
 * Returns how many there are; *nearest is to be freed. */
size_t brute_nearest_k(const brute *all, const double target[3], size_t k, octree_skip skip, uint64_t skip_id,
                       octree_neighbor **nearest);

/* An octree_point_visitor that adds to the brute in `context`. */
bool brute_collect(const octree_point *point, void *context);

/* Whether both hold the same pairs. Sorts both. */
bool brute_equal(brute *a, brute *b);

#endif
