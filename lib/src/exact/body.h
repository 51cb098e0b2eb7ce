/* SPDX-License-Identifier: MIT */
/* body.h - decides in real numbers how a body lies to other shapes.
 *
 * The box of a body spans the real numbers position - half to position + half on each axis; these ends need not be
 * doubles. All functions are exact for all finite values with half >= 0.
 */
#ifndef OCTREE_BODY_H
#define OCTREE_BODY_H

#include "exact.h"
#include "octree/types.h"

#include <stdbool.h>

/* Returns the sign of the real sum a + b + c + d: -1, 0 or 1. The error of the computed sum is at most 3 * 2^-53 times
 * the sum of the absolute values, which itself is rounded; sums of subnormal numbers are exact. Often a + b and c + d
 * cancel, as for two boxes on one floor. Then the real sum is that of the two rounding errors. Rounding keeps its sign.
 */
static inline int body_sign(double a, double b, double c, double d)
{
    const double one = a + b, other = c + d, sum = one + other, size = (fabs(a) + fabs(b)) + (fabs(c) + fabs(d));
    if (fabs(sum) > size * 0x1p-50)
        return sum > 0 ? 1 : -1;
    if (sum == 0) {
        const double rest = exact_error_of_sum(a, b, one) + exact_error_of_sum(c, d, other);
        return (rest > 0) - (rest < 0);
    }
    return exact_sign_of_sum((double[]){a, b, c, d}, 4);
}

/* Returns whether two bodies have a common point. Rounding is monotone: of two rounded sums, the greater one has the
 * greater real value. Only if they are equal, an exact sum decides. */
static inline bool bodies_meet(const octree_body *a, const octree_body *b)
{
    for (int i = 0; i < 3; i++) {
        const double way = fabs(a->position[i] - b->position[i]), reach = a->half[i] + b->half[i];
        if (way > reach)
            return false;
        if (way == reach && (body_sign(a->position[i], -b->position[i], -a->half[i], -b->half[i]) > 0 ||
                             body_sign(b->position[i], -a->position[i], -a->half[i], -b->half[i]) > 0))
            return false;
    }
    return true;
}

/* Returns whether a body and a closed box have a common point, and whether the body is inside the box. The corners
 * of the box may be infinite. */
bool body_meets_box(const octree_body *e, const octree_box *box);
bool body_is_in_box(const octree_body *e, const octree_box *box);

/* Returns whether a body and a closed ball have a common point, and whether the body is inside the ball. */
bool body_meets_ball(const octree_body *e, const double center[3], double radius);
bool body_is_in_ball(const octree_body *e, const double center[3], double radius);

/* Returns the sign of the distance of a body from a target minus the radius, which is >= 0: -1, 0 or 1. */
int body_compare_radius(const octree_body *e, const double target[3], double radius);

/* Compare the nearest corner of a body with the half-space normal . x <= offset: -1 if it is inside, 0 if it is on the
 * boundary, 1 if the whole body is outside. */
int body_compare_half_space(const octree_body *e, const double normal[3], double offset);

/* Returns whether the half-space normal . x <= offset has a point of the body, and whether it has all of them. */
bool body_meets_half_space(const octree_body *e, const double normal[3], double offset);
bool body_is_in_half_space(const octree_body *e, const double normal[3], double offset);

/* A squared distance from a target to a body, computed in doubles. The real square is within `error` of `value`,
 * unless `error` is not finite. */
typedef struct body_square {
    double value, error;
} body_square;

/* Compute the square of the distance from a target to a body, both multiplied by a power of two. */
body_square body_measure(const octree_body *e, const double target[3], double scale);

/* Returns the sign of the distance of `a` from the target minus the distance of `b`: -1, 0 or 1. */
int body_compare_distances(const octree_body *a, const octree_body *b, const double target[3]);

/* Returns the distance from a target to a body, within 4 ulp. Infinite only if the distance is beyond DBL_MAX. */
double body_distance(const octree_body *e, const double target[3]);

#endif
