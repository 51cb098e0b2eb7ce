/* SPDX-License-Identifier: MIT */
/* Relative to the box's middle the point goes from u = p - a to w = q - b, where p, q are the point's ends and a, b the
 * box's. On an axis on which it goes downwards by d = u - w > 0, it is within the size r from enter = (u - r) / d to
 * leave = (u + r) / d; upwards everything is mirrored. It is touched when the three intervals and 0..1 have a moment in
 * common: when every enter is at most 1 and at most every leave, and every leave is at least 0. The moments are
 * compared in doubles where their error allows; otherwise as fractions, by their cross products, exactly.
 */
#include "sweep.h"
#include "exact.h"

/* The ends on one axis. */
typedef struct ends {
    double a, b, p, q;
} ends;

static ends ends_on(const sweep *box, const double from[3], const double to[3], int axis)
{
    return (ends){box->from[axis], box->to[axis], from[axis], to[axis]};
}

/* ---- In doubles --------------------------------------------------------------------------------------------- */

/* When the box begins and ends to touch the point, as far as doubles can tell. */
typedef struct moments {
    double enter, leave; /* the last to enter, the first to leave */
    double error;        /* bound for both */
} moments;

/* At rest relative to the box: 1 or 0 when doubles can tell whether the axis is covered, else -1. Three roundings. */
static int guess_at_rest(const ends *e, double size)
{
    const double offset = fabs(e->p - e->a), error = (offset + size) * 0x1p-50;
    return offset + error < size ? 1 : offset - error > size ? 0 : -1;
}

/* Narrow the moments to those of one axis; false when doubles cannot tell its direction. With v = 2^-53, `length` is
 * off by at most 4v * travel, less than an eighth of itself, and the numerators by at most 4v * (|u| + r); so the
 * quotients are off by at most 16v times what is added up here, of which 32v is taken. The last term is for underflow.
 * Where a step of this computation overflows, the error is infinite or NaN. */
static bool narrow(moments *known, const ends *e, double size)
{
    const double step = e->b - e->a, own = e->q - e->p, travel = fabs(step) + fabs(own);
    const double length = fabs(step - own), way = step > own ? 1 : -1;
    if (!(length > travel * 0x1p-48))
        return false;
    const double offset = way * (e->p - e->a), reach = (fabs(offset) + size) / length;
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

/* 1 or 0 when doubles can tell, -1 when only exact arithmetic can. */
static int guess(const sweep *box, const double from[3], const double to[3])
{
    moments known = {.enter = 0, .leave = 1};
    int guessed = 1;
    for (int i = 0; i < 3; i++) {
        const ends e = ends_on(box, from, to, i);
        const bool rests = e.a == e.b && e.p == e.q;
        const int answer = rests ? guess_at_rest(&e, box->size) : narrow(&known, &e, box->size) ? 1 : -1;
        if (answer == 0)
            return 0;
        guessed = answer < 0 ? -1 : guessed;
    }
    if (known.enter - known.leave > 2 * known.error)
        return 0;
    return known.leave - known.enter > 2 * known.error ? guessed : -1;
}

/* ---- Exactly ------------------------------------------------------------------------------------------------ */

static int sign_of_sum(const double terms[], int count)
{
    exact_sum sum;
    exact_clear(&sum);
    for (int i = 0; i < count; i++)
        exact_add_product(&sum, 1, terms[i], 1);
    return exact_sign(&sum);
}

/* The sign of (u - w): 1 where the point comes from above relative to the box, 0 at rest. */
static int direction(const ends *e)
{
    return sign_of_sum((double[]){e->p, -e->a, -e->q, e->b}, 4);
}

/* Whether side * (point - middle) <= size. */
static bool is_inside(double point, double middle, int side, double size)
{
    return sign_of_sum((double[]){size, -side * point, side * middle}, 3) >= 0;
}

/* Add factor * (way * u + side * r) of one axis times the length of the way on another. */
static void add_cross(exact_sum *sum, int factor, const ends *e, int way, double reach, const ends *other,
                      int other_way)
{
    const double terms[3] = {way * e->p, -way * e->a, reach};
    const double length[4] = {other->p, -other->a, -other->q, other->b};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            exact_add_product(sum, factor * other_way, terms[i], length[j]);
}

/* Whether the point is within the size on axis `i` before it leaves it on axis `j`: leave_j - enter_i >= 0, times both
 * lengths. */
static bool enters_before(const ends *i, int way_i, const ends *j, int way_j, double size)
{
    exact_sum sum;
    exact_clear(&sum);
    add_cross(&sum, 1, j, way_j, size, i, way_i);
    add_cross(&sum, -1, i, way_i, -size, j, way_j);
    return exact_sign(&sum) >= 0;
}

static bool touches_exactly(const sweep *box, const double from[3], const double to[3])
{
    ends e[3];
    int way[3];
    for (int i = 0; i < 3; i++) {
        e[i] = ends_on(box, from, to, i);
        way[i] = direction(&e[i]);
        const int side =
            way[i] ? way[i] : 1; /* at rest both ends are one position, and the tests are of its two sides */
        if (!is_inside(e[i].q, e[i].b, side, box->size) || !is_inside(e[i].p, e[i].a, -side, box->size))
            return false;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (i != j && way[i] && way[j] && !enters_before(&e[i], way[i], &e[j], way[j], box->size))
                return false;
    return true;
}

bool sweep_touches(const sweep *box, const double from[3], const double to[3])
{
    const int guessed = guess(box, from, to);
    return guessed < 0 ? touches_exactly(box, from, to) : guessed == 1;
}
