/* SPDX-License-Identifier: MIT */
/* brute_bodies.h - an array of bodies that answers queries by linear scan: the oracle for tests of games with boxes.
 *
 * The comparisons use doubles. They are correct if sums and products of the coordinates are exact, as with small
 * multiples of 1/4; body_oracle.h is correct for all others. A point is a body without extent.
 */
#ifndef BRUTE_BODIES_H
#define BRUTE_BODIES_H

#include "octree/bodies.h"

typedef struct brute_bodies {
    octree_body *items;
    size_t count, room;
} brute_bodies;

/* An empty array is {0}. */
void brute_bodies_free(brute_bodies *all);

void brute_bodies_add(brute_bodies *all, const octree_body *body);

/* Returns the body with this id, or null. The body is valid until the array changes. */
octree_body *brute_bodies_find(const brute_bodies *all, uint64_t id);

/* Remove the body with this id, if there is one. The order of the other bodies changes. */
void brute_bodies_remove(brute_bodies *all, uint64_t id);

/* Returns whether two boxes have a common point. */
bool brute_bodies_overlap(const octree_body *a, const octree_body *b);

/* Returns whether a body has a common point with a closed box. */
bool brute_body_meets_box(const octree_body *body, const octree_box *box);

/* Returns the squared distance of a target to the box of a body: 0 inside. */
double brute_body_square(const octree_body *body, const double target[3]);

/* Add the k bodies nearest to a target to `nearest`, by distance, then by id, without the body `skip_id`. */
void brute_bodies_nearest(const brute_bodies *all, const double target[3], size_t k, uint64_t skip_id,
                          brute_bodies *nearest);

#endif
