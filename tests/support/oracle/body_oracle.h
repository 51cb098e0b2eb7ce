/* SPDX-License-Identifier: MIT */
/* body_oracle.h - tests of bodies in rational numbers (GMP): the oracle of bodies.h.
 *
 * Every finite double is a rational number, so each function computes exactly what bodies.h defines, without the
 * shortcuts of the library.
 */
#ifndef BODY_ORACLE_H
#define BODY_ORACLE_H

#include "octree/bodies.h"

/* Whether a body matches a region, as octree_region says. */
bool oracle_matches(const octree_region *region, const octree_body *body);

/* Whether the boxes of two bodies have a common point. */
bool oracle_overlap(const octree_body *a, const octree_body *b);

/* The sign of the distance from a target to body `a` minus the distance to body `b`. */
int oracle_compare_distances(const double target[3], const octree_body *a, const octree_body *b);

/* The sign of the time at which a ray or moving box first touches body `a` minus that of body `b`. It touches both. */
int oracle_compare_times(const octree_region *ray, const octree_body *a, const octree_body *b);

/* Whether `value` is within `steps` doubles of the real distance, or of the real time. */
bool oracle_distance_is(double value, unsigned steps, const double target[3], const octree_body *body);
bool oracle_time_is(double value, unsigned steps, const octree_region *ray, const octree_body *body);

#endif
