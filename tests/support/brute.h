/* brute.h - a plain array of points that answers by linear scan: the oracle that cannot be wrong about structure.
 */
#ifndef BRUTE_H
#define BRUTE_H

#include "octree/octree.h"

typedef struct brute {
    octree_point *points;
    size_t count;
    size_t capacity;
} brute;

/* An empty array is {0}. */
void brute_free(brute *all);

/* Add a point, pairs that are stored included. */
void brute_insert(brute *all, const double position[3], uint64_t id);

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

/* Whether a skip rule leaves this point out. */
bool brute_skips(const octree_point *point, const double target[3], octree_skip skip, uint64_t skip_id);

/* The nearest point by plain squared distances, ties to the lowest id: true where those squares are exact, as for
 * small whole coordinates. exact_oracle.h has the truth for all others. */
bool brute_nearest(const brute *all, const double target[3], octree_skip skip, uint64_t skip_id,
                   octree_neighbor *nearest);

/* An octree_point_visitor that adds to the brute in `context`. */
bool brute_collect(const octree_point *point, void *context);

/* Whether both hold the same pairs. Sorts both. */
bool brute_equal(brute *a, brute *b);

#endif
