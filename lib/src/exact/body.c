/* SPDX-License-Identifier: MIT */
/* body.c - decides in real numbers how a body lies to other shapes.
 *
 * Problem: the faces of a body, position +- half, are sums of two doubles, and rounding a face makes touching boxes
 * overlap or part.
 *
 * Idea: no face is ever computed. Each test is the sign of a sum of terms: "the boxes a and b do not meet on this axis"
 * is a.position - b.position - a.half - b.half > 0. The distance to a box is a sum of squares of such sums, and the
 * side of a half-space a sum of products. The sum is first computed in doubles with a bound of its error. If the bound
 * does not decide, the sum is computed exactly (exact.h).
 *
 * Cost: some ten additions; an exact sum only if the shapes touch or nearly touch.
 */
#include "body.h"
#include "metric.h"

/* Returns a face of a box as a finite number. A face at infinity excludes no point, and neither does DBL_MAX: no centre
 * is beyond it. */
static double finite_face(double face)
{
    return face > DBL_MAX ? DBL_MAX : face < -DBL_MAX ? -DBL_MAX : face;
}

/* Rounding is monotone: a rounded end of the body lies beyond a face only if the real end does. If they are equal, an
 * exact sum decides. */
bool body_meets_box(const octree_body *e, const octree_box *box)
{
    for (int i = 0; i < 3; i++) {
        const double p = e->position[i], h = e->half[i], min = box->min[i], max = box->max[i];
        if (p + h < min || max < p - h)
            return false;
        if ((p + h == min && body_sign(finite_face(min), -p, -h, 0) > 0) ||
            (p - h == max && body_sign(p, -finite_face(max), -h, 0) > 0))
            return false;
    }
    return true;
}

bool body_is_in_box(const octree_body *e, const octree_box *box)
{
    for (int i = 0; i < 3; i++)
        if (box->min[i] > DBL_MAX || box->max[i] < -DBL_MAX ||
            (box->min[i] >= -DBL_MAX && body_sign(box->min[i], -e->position[i], e->half[i], 0) > 0) ||
            (box->max[i] <= DBL_MAX && body_sign(e->position[i], -box->max[i], e->half[i], 0) > 0))
            return false;
    return true;
}

/* ---- Distances ---------------------------------------------------------------------------------------------- */

/* A real number as a sum of at most three doubles; 0 terms: the number 0. */
typedef struct terms {
    double term[3];
    int count;
} terms;

/* Returns the distance on one axis from the target to the body, in real numbers. */
static terms find_gap(const octree_body *e, const double target[3], int axis)
{
    const double c = e->position[axis], t = target[axis], h = e->half[axis];
    if (body_sign(t, -c, -h, 0) > 0)
        return (terms){{t, -c, -h}, 3};
    if (body_sign(c, -t, -h, 0) > 0)
        return (terms){{c, -t, -h}, 3};
    return (terms){{0, 0, 0}, 0};
}

/* Returns the distance on one axis from the target to the farther end of the body, in real numbers. */
static terms find_far_end(const octree_body *e, const double target[3], int axis)
{
    const double c = e->position[axis], t = target[axis], h = e->half[axis];
    return c >= t ? (terms){{c, -t, h}, 3} : (terms){{t, -c, h}, 3};
}

/* Add sign * (the square of the sum of the terms) to a sum. */
static void add_square(exact_sum *sum, int sign, const terms *t)
{
    for (int i = 0; i < t->count; i++) {
        exact_add_product(sum, sign, t->term[i], t->term[i]);
        for (int j = 0; j < i; j++)
            exact_add_product(sum, 2 * sign, t->term[i], t->term[j]);
    }
}

typedef terms find_terms(const octree_body *e, const double target[3], int axis);

static void add_squared_distance(exact_sum *sum, int sign, const octree_body *e, const double target[3],
                                 find_terms *find)
{
    for (int i = 0; i < 3; i++) {
        const terms t = find(e, target, i);
        add_square(sum, sign, &t);
    }
}

/* Returns the sign of the distance to the body, or to its farthest corner, minus the radius. */
static int compare_with_radius(const octree_body *e, const double center[3], double radius, find_terms *find)
{
    exact_sum sum;
    exact_clear(&sum);
    add_squared_distance(&sum, 1, e, center, find);
    exact_add_product(&sum, -1, radius, radius);
    return exact_sign(&sum);
}

/* Add the squared gap along one axis. Let u = 2^-53. The errors of |target - center| and of the gap are at most u *
 * |target - center| + u * |gap|, below 2u * size. The squaring and the addition each round once more. The factor covers
 * all of these errors, and 2^-1000 covers underflow. */
static void measure_axis(body_square *s, double gap, double size)
{
    const double inexact = size * 0x1p-51;
    s->value += gap * gap;
    s->error += inexact * (2 * gap + inexact) + gap * gap * 0x1p-50 + 0x1p-1000;
    if (s->value > DBL_MAX) /* the sum may overflow where no square does */
        s->error = HUGE_VAL;
}

body_square body_measure(const octree_body *e, const double target[3], double scale)
{
    body_square s = {0, 0};
    for (int i = 0; i < 3; i++) {
        const double offset = fabs(target[i] - e->position[i]), gap = offset - e->half[i], size = offset + e->half[i];
        if (!(gap < 0)) /* the rounded gap has the sign of the real one: rounding is monotone, and half is a double */
            measure_axis(&s, gap * scale, size * scale);
    }
    return s;
}

int body_compare_radius(const octree_body *e, const double target[3], double radius)
{
    const body_square s = body_measure(e, target, 1);
    const double square = radius * radius;
    const double error = s.error + square * 0x1p-50 + 0x1p-1000;
    if (fabs(s.value - square) > error) /* false if a value overflowed */
        return s.value < square ? -1 : 1;
    return compare_with_radius(e, target, radius, find_gap);
}

bool body_meets_ball(const octree_body *e, const double center[3], double radius)
{
    return body_compare_radius(e, center, radius) <= 0;
}

bool body_is_in_ball(const octree_body *e, const double center[3], double radius)
{
    body_square s = {0, 0};
    for (int i = 0; i < 3; i++) {
        const double far = fabs(center[i] - e->position[i]) + e->half[i];
        measure_axis(&s, far, far);
    }
    const double square = radius * radius;
    if (fabs(s.value - square) > s.error + square * 0x1p-50 + 0x1p-1000)
        return s.value < square;
    return compare_with_radius(e, center, radius, find_far_end) <= 0;
}

int body_compare_distances(const octree_body *a, const octree_body *b, const double target[3])
{
    exact_sum sum;
    exact_clear(&sum);
    add_squared_distance(&sum, 1, a, target, find_gap);
    add_squared_distance(&sum, -1, b, target, find_gap);
    return exact_sign(&sum);
}

/* If the difference of target and position overflows, the gap may still be a double. */
static double round_gap_exactly(const octree_body *e, const double target[3], int axis)
{
    const terms t = find_gap(e, target, axis);
    exact_sum sum;
    exact_clear(&sum);
    for (int i = 0; i < t.count; i++)
        exact_add_product(&sum, 1, t.term[i], 1);
    return exact_round(&sum);
}

/* Returns the distance on one axis from the target to the body. Two rounding errors are computed exactly, and added to
 * the rounded gap. They are added last, so their sum matters for the last bit only, unless the gap is much smaller than
 * its terms; then the second error is 0, and the sum is exact. So the gap has an error of little more than half an ulp.
 */
static double round_gap(const octree_body *e, const double target[3], int axis)
{
    const double c = e->position[axis], t = target[axis], h = e->half[axis], difference = t - c;
    const double error = exact_error_of_sum(t, -c, difference), offset = fabs(difference), gap = offset - h;
    if (offset > DBL_MAX)
        return round_gap_exactly(e, target, axis);
    const double rest = (difference < 0 ? -error : error) + exact_error_of_sum(offset, -h, gap);
    return gap + rest > 0 ? gap + rest : 0;
}

double body_distance(const octree_body *e, const double target[3])
{
    double gaps[3];
    if (e->half[0] == 0 && e->half[1] == 0 && e->half[2] == 0)
        return metric_distance(e->position, target);
    for (int i = 0; i < 3; i++)
        gaps[i] = round_gap(e, target, i);
    return metric_distance(gaps, (double[3]){0, 0, 0});
}

/* ---- Half-spaces -------------------------------------------------------------------------------------------- */

/* Returns the sign of normal . position + side * |normal| . half - offset. `side` is 1 for the corner of the body that
 * is farthest along the normal, and -1 for the opposite corner. */
static int sign_at_corner(const octree_body *e, const double normal[3], double offset, int side)
{
    double sum = -offset, size = fabs(offset);
    for (int i = 0; i < 3; i++) {
        const double along = normal[i] * e->position[i], reach = fabs(normal[i]) * e->half[i];
        sum += along + side * reach;
        size += fabs(along) + reach;
    }
    if (fabs(sum) > size * 0x1p-48 + 0x1p-1000) /* false if a value overflowed */
        return sum > 0 ? 1 : -1;
    exact_sum exact;
    exact_clear(&exact);
    exact_add_product(&exact, -1, offset, 1);
    for (int i = 0; i < 3; i++) {
        exact_add_product(&exact, 1, normal[i], e->position[i]);
        exact_add_product(&exact, side, fabs(normal[i]), e->half[i]);
    }
    return exact_sign(&exact);
}

int body_compare_half_space(const octree_body *e, const double normal[3], double offset)
{
    return sign_at_corner(e, normal, offset, -1);
}

bool body_meets_half_space(const octree_body *e, const double normal[3], double offset)
{
    return body_compare_half_space(e, normal, offset) <= 0;
}

bool body_is_in_half_space(const octree_body *e, const double normal[3], double offset)
{
    return sign_at_corner(e, normal, offset, 1) <= 0;
}
