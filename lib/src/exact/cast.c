/* SPDX-License-Identifier: MIT */
/* cast.c - decides in real numbers when a box that moves in a straight line first touches a body at rest.
 *
 * Problem: rays graze faces, pass through edges and corners, or start on a face. There, rounded slab tests miss boxes,
 * hit boxes that they should miss, and order two hits at the same place by chance.
 *
 * Idea (slab test, Kay and Kajiya 1986): on an axis on which the box moves with the speed d > 0, it touches the body
 * from the time enter = (offset - reach) / d to leave = (offset + reach) / d, where `offset` is the way from the origin
 * to the body's position in the direction of the motion, and `reach` the sum of both half extents. The box touches the
 * extent if and only if every enter <= every leave, every leave >= 0 and every enter <= length; without motion on an
 * axis, if |offset| <= reach. The first time is the largest enter, or 0.
 *
 * offset - reach is a sum of four doubles, and d a sum of one or two. Times are first compared as doubles with an error
 * bound. If the bound does not decide, the fractions are compared by their cross products in exact sums (exact.h).
 *
 * Cost: three divisions when a cast is made, none for a body, and one for the time of a hit; exact sums only where the
 * box grazes.
 */
#include "cast.h"

static cast make_cast(const double origin[3], double step[3][2], const double half[3], double length)
{
    cast c = {.length = length};
    for (int i = 0; i < 3; i++) {
        c.origin[i] = origin[i];
        c.half[i] = half[i];
        c.step[i][0] = step[i][0];
        c.step[i][1] = step[i][1];
        const double speed = step[i][0] + step[i][1];
        c.sign[i] = (speed > 0) - (speed < 0); /* the rounded sum has the sign of the real sum */
        c.speed[i] = fabs(speed);
        c.inverse[i] = c.speed[i] > 0x1p1000 ? NAN : 1 / c.speed[i];
    }
    return c;
}

cast cast_make_ray(const double origin[3], const double direction[3], double length, const double half[3])
{
    double step[3][2] = {{direction[0], 0}, {direction[1], 0}, {direction[2], 0}};
    return make_cast(origin, step, half, length);
}

cast cast_make_sweep(const double from[3], const double to[3], const double half[3])
{
    double step[3][2] = {{to[0], -from[0]}, {to[1], -from[1]}, {to[2], -from[2]}};
    return make_cast(from, step, half, 1);
}

/* ---- In doubles --------------------------------------------------------------------------------------------- */

/* The times at which the box enters and leaves a body, on all axes that were examined so far. */
typedef struct passage {
    double enter, leave;
    double error;  /* a bound for the errors of both */
    double latest; /* an upper bound of the times of entering */
} passage;

/* Intersect the passage with that on one more axis. `inverse` is 1 / speed. Let u = 2^-53. The error of the numerators
 * is at most 3u * (|offset| + reach), that of the speed u, that of its inverse u, and that of the product u. The last
 * term covers underflow. Returns false if a value overflowed. */
static bool narrow_passage(passage *known, double offset, double reach, double inverse)
{
    const double enter = (offset - reach) * inverse, leave = (offset + reach) * inverse;
    const double error = (fabs(offset) + reach) * inverse * 0x1p-50 + 0x1p-1000;
    known->enter = enter > known->enter ? enter : known->enter;
    known->leave = leave < known->leave ? leave : known->leave;
    known->error = error > known->error ? error : known->error;
    known->latest = enter + error > known->latest ? enter + error : known->latest;
    return error <= DBL_MAX;
}

/* Returns 1 if the box touches the body, 0 if it does not, and -1 if doubles do not decide. */
static int test_in_doubles(const cast *c, const octree_body *e, cast_time *first)
{
    passage known = {0, c->length, 0, -HUGE_VAL};
    bool certain = true;
    for (int i = 0; i < 3; i++) {
        const double offset = e->position[i] - c->origin[i], reach = e->half[i] + c->half[i];
        if (c->sign[i]) {
            certain &= narrow_passage(&known, c->sign[i] * offset, reach, c->inverse[i]);
            continue;
        }
        if (body_sign(e->position[i], -c->origin[i], -e->half[i], -c->half[i]) > 0 ||
            body_sign(c->origin[i], -e->position[i], -e->half[i], -c->half[i]) > 0)
            return 0;
    }
    *first = (cast_time){known.enter, !certain ? HUGE_VAL : known.latest < 0 ? 0 : known.error};
    if (!certain)
        return -1;
    if (known.enter - known.leave > 2 * known.error)
        return 0;
    return known.leave - known.enter > 2 * known.error ? 1 : -1;
}

/* ---- Exactly ------------------------------------------------------------------------------------------------ */

/* A time as a fraction: the sum of four doubles over the absolute value of the direction on an axis. */
typedef struct fraction {
    double terms[4];
    int axis;
} fraction;

/* Returns the time of entering (side -1) or leaving (side 1) on an axis on which the box moves. */
static fraction find_time_at_face(const cast *c, const octree_body *e, int axis, int side)
{
    const int sign = c->sign[axis];
    return (fraction){{sign * e->position[axis], -sign * c->origin[axis], side * e->half[axis], side * c->half[axis]},
                      axis};
}

static int sign_of_time(const fraction *t)
{
    return exact_sign_of_sum(t->terms, 4);
}

/* Add factor * (the numerator of a time) * (the speed on another axis) to a sum. */
static void add_cross_product(exact_sum *sum, const cast *c, int factor, const fraction *time, int axis)
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 2; j++)
            exact_add_product(sum, factor * c->sign[axis], time->terms[i], c->step[axis][j]);
}

/* Returns the sign of a - b for two times. */
static int compare_times(const cast *c, const fraction *a, const fraction *b)
{
    exact_sum sum;
    exact_clear(&sum);
    add_cross_product(&sum, c, 1, a, b->axis);
    add_cross_product(&sum, c, -1, b, a->axis);
    return exact_sign(&sum);
}

/* Returns whether a time is not above the length of the cast. */
static bool is_within_length(const cast *c, const fraction *time)
{
    if (c->length > DBL_MAX)
        return true;
    exact_sum sum;
    exact_clear(&sum);
    for (int i = 0; i < 4; i++)
        exact_add_product(&sum, 1, time->terms[i], 1);
    for (int j = 0; j < 2; j++)
        exact_add_product(&sum, -c->sign[time->axis], c->length, c->step[time->axis][j]);
    return exact_sign(&sum) <= 0;
}

/* Find the latest time of entering. Returns false if there is none after 0: the box touches the body at its start. */
static bool find_entry(const cast *c, const octree_body *e, fraction *entry)
{
    bool found = false;
    for (int i = 0; i < 3; i++) {
        if (c->sign[i] == 0)
            continue;
        const fraction time = find_time_at_face(c, e, i, -1);
        if (found ? compare_times(c, &time, entry) > 0 : sign_of_time(&time) > 0)
            *entry = time;
        found = found || sign_of_time(&time) > 0;
    }
    return found;
}

/* The axes without motion were tested exactly before. */
static bool test_exactly(const cast *c, const octree_body *e)
{
    fraction entry;
    const bool enters = find_entry(c, e, &entry);
    if (enters && !is_within_length(c, &entry))
        return false;
    for (int i = 0; i < 3; i++) {
        if (c->sign[i] == 0)
            continue;
        const fraction exit = find_time_at_face(c, e, i, 1);
        if (enters ? compare_times(c, &entry, &exit) > 0 : sign_of_time(&exit) < 0)
            return false;
    }
    return true;
}

bool cast_touches(const cast *c, const octree_body *e, cast_time *first)
{
    const int answer = test_in_doubles(c, e, first);
    return answer < 0 ? test_exactly(c, e) : answer;
}

/* Returns whether one axis certainly has the latest time of entering, in doubles. If so, *axis receives it; -1: the box
 * touches the body at its start. */
static bool find_entry_in_doubles(const cast *c, const octree_body *e, int *axis)
{
    double latest = 0, second = -HUGE_VAL, error = 0;
    *axis = -1;
    for (int i = 0; i < 3; i++) {
        if (c->sign[i] == 0)
            continue;
        passage one = {-HUGE_VAL, HUGE_VAL, 0, -HUGE_VAL};
        if (!narrow_passage(&one, c->sign[i] * (e->position[i] - c->origin[i]), e->half[i] + c->half[i], c->inverse[i]))
            return false;
        second = one.enter > latest ? latest : one.enter > second ? one.enter : second;
        *axis = one.enter > latest ? i : *axis;
        latest = one.enter > latest ? one.enter : latest;
        error = one.error > error ? one.error : error;
    }
    return latest - second > 2 * error;
}

/* If both casts enter on the same axis, the faces decide. Things on one floor are an example: all of their lower faces
 * are hit at the same time. */
int cast_compare(const cast *c, const octree_body *a, const octree_body *b)
{
    int i, other;
    if (find_entry_in_doubles(c, a, &i) && find_entry_in_doubles(c, b, &other) && i >= 0 && i == other)
        return body_sign(c->sign[i] * a->position[i], -c->sign[i] * b->position[i], -a->half[i], b->half[i]);
    fraction of_a, of_b;
    const bool enters_a = find_entry(c, a, &of_a), enters_b = find_entry(c, b, &of_b);
    return enters_a && enters_b ? compare_times(c, &of_a, &of_b) : enters_a - enters_b;
}

/* Returns the sum of four terms, rounded: in doubles if hardly anything cancels out, else exactly.
 *
 * The errors of the three sums are added to the result (Knuth's TwoSum). The remaining error is below 2^-100 times the
 * size of the terms. */
static double round_sum(const double t[4], double part)
{
    const double x = t[0] + t[1], y = t[2] + t[3], sum = x + y;
    const double a = x - t[1], b = y - t[3], d = sum - y;
    const double errors =
        ((t[0] - a) + (t[1] - (x - a))) + ((t[2] - b) + (t[3] - (y - b))) + ((x - d) + (y - (sum - d)));
    const double size = (fabs(t[0]) + fabs(t[1])) + (fabs(t[2]) + fabs(t[3]));
    if (part == 1 && fabs(sum) > size * 0x1p-40 && size < 0x1p1000)
        return sum + errors;
    exact_sum exact;
    exact_clear(&exact);
    for (int i = 0; i < 4; i++)
        exact_add_product(&exact, 1, t[i], part);
    return exact_round(&exact);
}

/* Returns the quotient of a time. The numerator, the speed and the quotient are rounded once each. If the numerator or
 * the speed overflows, eighths are divided: then no part is so small that its eighth would be inexact, unless the time
 * is infinite. */
static double divide(const cast *c, const fraction *time)
{
    const double *step = c->step[time->axis];
    const double way = round_sum(time->terms, 1), speed = c->speed[time->axis];
    if (way <= DBL_MAX && speed <= DBL_MAX)
        return way / speed; /* infinite only if the time is */
    return round_sum(time->terms, 0.125) / fabs(step[0] * 0.125 + step[1] * 0.125);
}

double cast_first_time(const cast *c, const octree_body *e)
{
    fraction entry;
    int axis;
    const bool certain = find_entry_in_doubles(c, e, &axis);
    if (certain ? axis < 0 : !find_entry(c, e, &entry))
        return 0;
    if (certain)
        entry = find_time_at_face(c, e, axis, -1);
    return divide(c, &entry);
}
