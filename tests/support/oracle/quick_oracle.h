/* SPDX-License-Identifier: MIT */
/* quick_oracle.h - makes the decisions of exact_oracle.h a hundred times faster. The functions compute with long
 * doubles of 64 bits and a wide exponent, bound their rounding errors, and call exact_oracle.h if the bound does not
 * decide. They share no code with the library. */
#ifndef QUICK_ORACLE_H
#define QUICK_ORACLE_H

#include "octree/octree.h"

/* The sign of |a - target| - |b - target|. */
int quick_compare(const double target[3], const double a[3], const double b[3]);

/* The sign of |p - center| - (radius + epsilon); the sum is at least 0. */
int quick_compare_radius(const double center[3], const double p[3], double radius, double epsilon);

/* The sign of |a - target| - (1 + ratio) * |b - target|, for ratio >= 0. */
int quick_compare_ratio(const double target[3], const double a[3], const double b[3], double ratio);

/* The sign of |a - target| - (|b - target| + length), for length >= 0. */
int quick_compare_longer(const double target[3], const double a[3], const double b[3], double length);

/* Whether `distance` is within `steps` doubles of the real distance from a to b; at least 2 steps. */
bool quick_distance_is(double distance, unsigned steps, const double a[3], const double b[3]);

/* Whether |p - center| <= size, on one axis. */
bool quick_within(double center, double size, double p);

/* Whether a box that moves from `from` to `to` touches the resting point p. */
bool quick_touches(const double from[3], const double to[3], double size, const double p[3]);

/* The largest k of quick_nearest_k(). */
#define QUICK_NEAREST_MOST 16

/* The k nearest points by the real distance, ties to the lowest id, into nearest[0 .. min(k, count) - 1]; ids differ.
 */
void quick_nearest_k(const octree_point *points, size_t count, const double target[3], size_t k,
                     const octree_point **nearest);

#endif
