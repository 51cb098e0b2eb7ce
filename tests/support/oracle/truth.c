/* SPDX-License-Identifier: MIT */
/* truth.c - see truth.h. */
#include "truth.h"
#include "quick_oracle.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

double round_to_float(double x)
{
    const volatile float narrow = (float)fmax(-FLT_MAX, fmin(FLT_MAX, x));
    return narrow;
}

static double rounded(double x, octree_precision precision)
{
    return precision == OCTREE_FLOATS ? round_to_float(x) : x;
}

static void place(const double from[3], octree_precision precision, double to[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = rounded(from[i], precision);
}

/* The positions that the promise is about; named[i]: how often point i was named. False when an id is none. */
typedef struct scan {
    const octree_query *query;
    octree_query asked;
    octree_point points[TRUTH_POINTS];
    size_t named[TRUTH_POINTS];
    size_t count;
} scan;

static bool scan_make(scan *s, const octree_query *query, const octree_point *points, size_t count)
{
    s->query = query;
    s->asked = *query;
    s->count = count;
    place(query->target, query->precision, s->asked.target);
    place(query->box.min, query->precision, s->asked.box.min);
    place(query->box.max, query->precision, s->asked.box.max);
    s->asked.radius = rounded(query->radius, query->precision);
    memset(s->named, 0, count * sizeof *s->named);
    for (size_t i = 0; i < count; i++) {
        s->points[i].id = i;
        place(points[i].position, query->precision, s->points[i].position);
    }
    for (size_t i = 0; i < query->answer_count; i++)
        if (query->answer[i] >= count || s->named[query->answer[i]]++ > 0)
            return false;
    return true;
}

/* ---- Boxes and balls ---------------------------------------------------------------------------------------- */

static bool is_in(const scan *s, const double at[3], double epsilon)
{
    const octree_query *q = &s->asked;
    if (q->kind == OCTREE_QUERY_RADIUS)
        return quick_compare_radius(q->target, at, q->radius, epsilon) <= 0;
    bool in = true;
    for (int i = 0; i < 3; i++)
        in &= at[i] >= q->box.min[i] && at[i] <= q->box.max[i];
    return in;
}

static truth truth_of_set(const scan *s)
{
    bool right = true;
    for (size_t i = 0; right && i < s->count; i++)
        right = s->named[i] ? is_in(s, s->points[i].position, s->query->epsilon) : !is_in(s, s->points[i].position, 0);
    return right ? TRUTH_RIGHT : TRUTH_WRONG;
}

/* ---- Neighbours --------------------------------------------------------------------------------------------- */

static const double *sorted_by;

static int compare_points(const void *a, const void *b)
{
    const octree_point *const *p = a, *const *q = b;
    return quick_compare(sorted_by, (*p)->position, (*q)->position);
}

static void sort(const scan *s, const octree_point **list, size_t count)
{
    sorted_by = s->asked.target;
    qsort(list, count, sizeof *list, compare_points);
}

/* The k nearest of all, by distance. */
static void list_nearest(const scan *s, size_t k, const octree_point **list)
{
    if (k <= QUICK_NEAREST_MOST) {
        quick_nearest_k(s->points, s->count, s->asked.target, k, list);
        return;
    }
    for (size_t i = 0; i < s->count; i++)
        list[i] = &s->points[i];
    sort(s, list, s->count);
}

static truth truth_of_neighbors(const scan *s)
{
    static const double hair = 0x1p-44;
    static const octree_point *nearest[TRUTH_POINTS], *named[TRUTH_POINTS];
    const octree_query *q = &s->asked;
    const size_t k = q->kind == OCTREE_QUERY_NEAREST ? 1 : q->k, expected = k < s->count ? k : s->count;
    truth answer = TRUTH_RIGHT;
    if (q->answer_count != expected)
        return TRUTH_WRONG;
    for (size_t i = 0; i < expected; i++)
        named[i] = &s->points[q->answer[i]];
    sort(s, named, expected);
    list_nearest(s, expected, nearest);
    for (size_t i = 0; i < expected; i++) {
        const double *a = named[i]->position, *b = nearest[i]->position;
        if (quick_compare_ratio(q->target, a, b, q->epsilon) <= 0)
            continue;
        if (q->epsilon == 0 || quick_compare_ratio(q->target, a, b, q->epsilon + hair) > 0)
            return TRUTH_WRONG;
        answer = TRUTH_OPEN;
    }
    return answer;
}

truth truth_of(const octree_query *query, const octree_point *points, size_t count)
{
    static scan s;
    if (!scan_make(&s, query, points, count))
        return TRUTH_WRONG;
    return octree_query_about(query->kind)->neighbors ? truth_of_neighbors(&s) : truth_of_set(&s);
}
