/* SPDX-License-Identifier: MIT */
/* exact_oracle.h - exact squared distances as GMP integers: the oracle for near ties and extreme scales.
 *
 * Every finite double is a whole multiple of 2^-1074. In this unit doubles are integers, so sums and squares are
 * exact. */
#ifndef EXACT_ORACLE_H
#define EXACT_ORACLE_H

#include "octree/octree.h"

/* The sign of |a - target|^2 - |b - target|^2. */
int exact_compare(const double target[3], const double a[3], const double b[3]);

/* The nearest point by the real distance, ties to the lowest id. Null when all are skipped. */
const octree_point *exact_nearest(const octree_point *points, size_t count, const double target[3], octree_skip skip,
                                  uint64_t skip_id);

/* Store all points that the skip rule keeps in `sorted`: by real distance, then by id, then by position. Returns their
 * number. */
size_t exact_nearest_sorted(const octree_point *points, size_t count, const double target[3], octree_skip skip,
                            uint64_t skip_id, octree_point *sorted);

/* The sign of |p - center| - (radius + epsilon). */
int exact_compare_radius(const double center[3], const double p[3], double radius, double epsilon);

/* The sign of |a - target| - (1 + ratio) * |b - target|. */
int exact_compare_ratio(const double target[3], const double a[3], const double b[3], double ratio);

/* The sign of |a - target| - (|b - target| + length). */
int exact_compare_longer(const double target[3], const double a[3], const double b[3], double length);

/* Whether `distance` is within `steps` doubles of the real distance from a to b. */
bool exact_distance_is(double distance, unsigned steps, const double a[3], const double b[3]);

/* Whether |p - center| <= size. */
bool exact_within(double center, double size, double p);

/* Whether a box that moves from `from` to `to` touches a point that moves from p to q in the same time. */
bool exact_touches(const double from[3], const double to[3], double size, const double p[3], const double q[3],
                   const double half[3]);

/* Whether the plane k/2^depth of [low, high] is a double; then *plane is that double. */
bool exact_plane(double low, double high, uint32_t k, unsigned depth, double *plane);

/* Whether `plane` is within `steps` doubles of max(|low|, |high|)'s spacing from the real plane k/2^depth. */
bool exact_plane_is_near(double low, double high, uint32_t k, unsigned depth, unsigned steps, double plane);

#endif
