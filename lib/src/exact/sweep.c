/* SPDX-License-Identifier: MIT */
/* sweep.c - decides whether a moving box touches a moving body.
 *
 * Problem: a box and a point move in straight lines during the time 0..1. Testing the two end positions misses fast
 * points; testing several moments in between only makes such errors rarer. A rounded time of contact gives wrong
 * answers at grazing contacts.
 *
 * Idea (slab test): subtract the box's motion, so that only the point moves, from u = p - a to w = q - b, where p, q
 * are the point's ends and a, b the box's. On an axis with d = u - w > 0 the point is within the half size r of the box
 * from the time enter = (u - r) / d to leave = (u + r) / d; for d < 0 everything is mirrored. Box and point touch if
 * and only if the three intervals and the interval 0..1 share a moment: every enter <= 1, every enter <= every leave,
 * every leave >= 0.
 *
 * A body with extent is a point for a larger box: r is the sum of both half sizes, which is not rounded.
 *
 * Times are first compared in doubles with an error bound. If the bound does not decide, fractions are compared by
 * their cross products in exact sums (exact.h). Cost: a few divisions; exact sums only for grazing contacts.
 */
#include "sweep.h"
#include "exact.h"

/* One axis: the box moves from a to b, the body's centre moves from p to q, and they touch within the real distance
 * size + half of each other. */
typedef struct ends {
    double a, b, p, q;
    double size, half;
} ends;

static ends make_ends_on_axis(const sweep *box, const double from[3], const double to[3], const double half[3],
                              int axis)
{
    return (ends){box->from[axis], box->to[axis], from[axis], to[axis], box->size, half ? half[axis] : 0};
}

/* ---- In doubles --------------------------------------------------------------------------------------------- */

/* The time interval, in doubles, during which the point is within the box on all axes that were examined so far. */
typedef struct moments {
    double enter, leave; /* the latest time of entering, and the earliest time of leaving, on the examined axes */
    double error;        /* an error bound for `enter` and `leave` */
} moments;

/* Test an axis on which neither the box nor the point moves. Returns 1 if the point is within reach of the box's
 * centre, 0 if it is not, and -1 if doubles do not decide. The error bound covers four roundings. */
static int test_axis_at_rest(const ends *e)
{
    const double size = e->size + e->half, offset = fabs(e->p - e->a), error = (offset + size) * 0x1p-50;
    return offset + error < size ? 1 : offset - error > size ? 0 : -1;
}

/* Intersect the interval of contact with the interval of one more axis. Returns false if doubles do not decide: the
 * direction of the relative motion is uncertain, or the error bound is 1 or more.
 *
 * Let v = 2^-53. The error of `length` is at most 4v * travel, which is less than an eighth of `length`. The error of
 * the numerators is at most 5v * (|u| + r). So the error of the quotients is at most 17v times the sum in `error`; the
 * code uses 32v. The last term of `error` covers underflow. If a step overflows, the error is infinite or NaN, and the
 * result is false. */
static bool intersect_axis(moments *known, const ends *e)
{
    const double size = e->size + e->half, step = e->b - e->a, own = e->q - e->p, travel = fabs(step) + fabs(own);
    const double length = fabs(step - own), direction = step > own ? 1 : -1;
    if (!(length > travel * 0x1p-48))
        return false;
    const double offset = direction * (e->p - e->a), reach = (fabs(offset) + size) / length;
    const double enter = (offset - size) / length, leave = (offset + size) / length;
    const double latest = fmax(fabs(enter), fabs(leave));
    const double error = (reach + latest * (travel / length)) * 0x1p-48 + 0x1p-1000;
    if (!(error < 1))
        return false;
    known->enter = fmax(known->enter, enter);
    known->leave = fmin(known->leave, leave);
    known->error = fmax(known->error, error);
    return true;
}

/* Returns 1 if box and point touch, 0 if they do not, and -1 if doubles do not decide. */
static int test_contact_in_doubles(const ends all[3])
{
    moments known = {.enter = 0, .leave = 1};
    int result = 1;
    for (int i = 0; i < 3; i++) {
        const ends *e = &all[i];
        const bool rests = e->a == e->b && e->p == e->q;
        const int answer = rests ? test_axis_at_rest(e) : intersect_axis(&known, e) ? 1 : -1;
        if (answer == 0)
            return 0;
        result = answer < 0 ? -1 : result;
    }
    if (known.enter - known.leave > 2 * known.error)
        return 0;
    return known.leave - known.enter > 2 * known.error ? result : -1;
}

/* ---- Exactly ------------------------------------------------------------------------------------------------ */

/* Returns the sign of u - w: 1 if the point moves down relative to the box, -1 if it moves up, 0 if it is at rest. */
static int sign_of_relative_motion(const ends *e)
{
    return exact_sign_of_sum((double[]){e->p, -e->a, -e->q, e->b}, 4);
}

/* Returns whether side * (point - middle) <= size + half, by exact comparison. `side` is 1 or -1. */
static bool is_within_reach(const ends *e, double point, double middle, int side)
{
    return exact_sign_of_sum((double[]){e->size, e->half, -side * point, side * middle}, 4) >= 0;
}

/* Add factor * (direction * u + factor * (size + half)) * |u - w| to the sum. u and `direction` are those of the axis
 * `e`; |u - w|, the length of the relative motion, is that of the axis `other`. */
static void add_cross_product(exact_sum *sum, int factor, const ends *e, int direction, const ends *other,
                              int other_direction)
{
    const double terms[4] = {direction * e->p, -direction * e->a, factor * e->size, factor * e->half};
    const double length[4] = {other->p, -other->a, -other->q, other->b};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            exact_add_product(sum, factor * other_direction, terms[i], length[j]);
}

/* Returns whether the point enters on axis `i` not later than it leaves on axis `j`. The condition leave_j - enter_i >=
 * 0 is multiplied by the lengths of both motions, so that no division is needed. */
static bool is_entry_before_exit(const ends *i, int direction_i, const ends *j, int direction_j)
{
    exact_sum sum;
    exact_clear(&sum);
    add_cross_product(&sum, 1, j, direction_j, i, direction_i);
    add_cross_product(&sum, -1, i, direction_i, j, direction_j);
    return exact_sign(&sum) >= 0;
}

static bool test_contact_exactly(const ends e[3])
{
    int direction[3];
    for (int i = 0; i < 3; i++) {
        direction[i] = sign_of_relative_motion(&e[i]);
        /* On an axis without relative motion, the point has one position relative to the box. One of the two tests
         * compares this position with the box's upper face, the other test with its lower face. */
        const int side = direction[i] ? direction[i] : 1;
        if (!is_within_reach(&e[i], e[i].q, e[i].b, side) || !is_within_reach(&e[i], e[i].p, e[i].a, -side))
            return false;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (i != j && direction[i] && direction[j] &&
                !is_entry_before_exit(&e[i], direction[i], &e[j], direction[j]))
                return false;
    return true;
}

bool sweep_touches(const sweep *box, const double from[3], const double to[3], const double half[3])
{
    ends e[3];
    for (int i = 0; i < 3; i++)
        e[i] = make_ends_on_axis(box, from, to, half, i);
    const int result = test_contact_in_doubles(e);
    return result < 0 ? test_contact_exactly(e) : result == 1;
}
