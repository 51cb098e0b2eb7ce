/* SPDX-License-Identifier: MIT */
/* quick_oracle.c - see quick_oracle.h.
 *
 * Where long doubles have 64 bits and 15 of exponent, sums and squares of doubles neither overflow nor underflow: a
 * difference is off by a factor of 1 + u at most (u = LDBL_EPSILON / 2), a squared distance by (1 + u)^5, and all that
 * is compared here by less than 1 + 8 u. Two values are told apart when they differ by more than 32 u of their sum.
 */
#include "quick_oracle.h"

#include <float.h>
#include <math.h>

#include "exact_oracle.h"

#if LDBL_MANT_DIG >= 64 && LDBL_MAX_EXP >= 16384
enum { LONG_DOUBLES_ARE_WIDE = 1 };
#else
enum { LONG_DOUBLES_ARE_WIDE = 0 }; /* all is decided exactly, and slowly */
#endif

static const long double margin = 16 * LDBL_EPSILON;

static long double squared_distance(const double a[3], const double b[3])
{
    const long double x = (long double)a[0] - b[0], y = (long double)a[1] - b[1], z = (long double)a[2] - b[2];
    return x * x + y * y + z * z;
}

/* Whether two values >= 0 with the error above are surely unlike. */
static bool are_apart(long double a, long double b)
{
    return LONG_DOUBLES_ARE_WIDE && fabsl(a - b) > margin * (a + b);
}

static int sign(long double a, long double b)
{
    return (a > b) - (a < b);
}

int quick_compare(const double target[3], const double a[3], const double b[3])
{
    const long double to_a = squared_distance(target, a), to_b = squared_distance(target, b);
    return are_apart(to_a, to_b) ? sign(to_a, to_b) : exact_compare(target, a, b);
}

int quick_compare_radius(const double center[3], const double p[3], double radius, double epsilon)
{
    const long double to_p = squared_distance(center, p), reach = (long double)radius + epsilon;
    return are_apart(to_p, reach * reach) ? sign(to_p, reach * reach)
                                          : exact_compare_radius(center, p, radius, epsilon);
}

int quick_compare_ratio(const double target[3], const double a[3], const double b[3], double ratio)
{
    const long double to_a = squared_distance(target, a), factor = 1 + (long double)ratio;
    const long double to_b = factor * factor * squared_distance(target, b);
    return are_apart(to_a, to_b) ? sign(to_a, to_b) : exact_compare_ratio(target, a, b, ratio);
}

int quick_compare_longer(const double target[3], const double a[3], const double b[3], double length)
{
    const long double to_a = sqrtl(squared_distance(target, a)), to_b = sqrtl(squared_distance(target, b)) + length;
    return are_apart(to_a, to_b) ? sign(to_a, to_b) : exact_compare_longer(target, a, b, length);
}

bool quick_distance_is(double distance, unsigned steps, const double a[3], const double b[3])
{
    /* The doubles beside a normal one are at least a 2^-53rd of it away; what was rounded once is within that. */
    const long double off = fabsl(sqrtl(squared_distance(a, b)) - distance);
    if (LONG_DOUBLES_ARE_WIDE && distance >= DBL_MIN && distance <= DBL_MAX && steps >= 2 &&
        off < (long double)distance * 0x1.8p-53L)
        return true;
    return exact_distance_is(distance, steps, a, b);
}

bool quick_within(double center, double size, double p)
{
    const long double distance = fabsl((long double)p - center);
    return are_apart(distance, size) ? distance < size : exact_within(center, size, p);
}

/* Moments t of a step, between which the truth lies. */
typedef struct moment {
    long double least, most;
} moment;

/* offset / way, where the offset is a sum of two doubles of at most `reach` in all. */
static moment moment_of(long double offset, long double reach, long double way)
{
    const long double at = offset / way, off = margin * reach / way;
    return (moment){at - off, at + off};
}

/* Narrow [first, last] to the moments of one axis. False when it is never covered there, at rest. */
static bool narrow(moment *first, moment *last, double from, double to, double size, double p)
{
    if (from == to)
        return quick_within(from, size, p);
    const long double turned = to < from ? -1 : 1; /* mirrored, it goes upwards */
    const long double offset = turned * ((long double)p - from), way = turned * ((long double)to - from);
    const long double reach = fabsl(offset) + size;
    const moment low = moment_of(offset - size, reach, way), high = moment_of(offset + size, reach, way);
    first->least = fmaxl(first->least, low.least);
    first->most = fmaxl(first->most, low.most);
    last->least = fminl(last->least, high.least);
    last->most = fminl(last->most, high.most);
    return true;
}

bool quick_touches(const double from[3], const double to[3], double size, const double p[3])
{
    moment first = {0, 0}, last = {1, 1};
    for (int axis = 0; axis < 3; axis++)
        if (!narrow(&first, &last, from[axis], to[axis], size, p[axis]))
            return false;
    if (LONG_DOUBLES_ARE_WIDE && first.least > last.most)
        return false;
    if (LONG_DOUBLES_ARE_WIDE && first.most < last.least)
        return true;
    return exact_touches(from, to, size, p, p, NULL);
}

/* A point, and its squared distance with the error above. */
typedef struct ranked {
    long double square;
    const octree_point *point;
} ranked;

static bool is_nearer(const double target[3], const ranked *a, const ranked *b)
{
    if (are_apart(a->square, b->square))
        return a->square < b->square;
    const int order = exact_compare(target, a->point->position, b->point->position);
    return order < 0 || (order == 0 && a->point->id < b->point->id);
}

void quick_nearest_k(const octree_point *points, size_t count, const double target[3], size_t k,
                     const octree_point **nearest)
{
    ranked best[QUICK_NEAREST_MOST + 1];
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        const ranked next = {squared_distance(target, points[i].position), &points[i]};
        if (LONG_DOUBLES_ARE_WIDE && found == k && next.square > best[k - 1].square * (1 + 4 * margin))
            continue; /* surely no nearer than k others: most are */
        size_t at = found;
        for (; at > 0 && is_nearer(target, &next, &best[at - 1]); at--)
            best[at] = best[at - 1];
        best[at] = next;
        found += found < k;
    }
    for (size_t i = 0; i < found; i++)
        nearest[i] = best[i].point;
}
