/* SPDX-License-Identifier: MIT */
/* answer_error.c - see answer_error.h. */
#include "answer_error.h"

#include "quick_oracle.h"

#include <math.h>
#include <stdlib.h>

static long double squared_distance(const double a[3], const double b[3])
{
    long double sum = 0;
    for (int axis = 0; axis < 3; axis++) {
        const long double difference = (long double)a[axis] - b[axis];
        sum += difference * difference;
    }
    return sum;
}

/* The distance from target to a, divided by that to b. Exactly 1 if both are equal as real numbers; above 1 if the
 * first is greater. */
static double distance_ratio(const double target[3], const double a[3], const double b[3])
{
    const int order = quick_compare(target, a, b);
    if (order == 0)
        return 1;
    const double ratio = (double)sqrtl(squared_distance(target, a) / squared_distance(target, b));
    return order > 0 ? fmax(ratio, nextafter(1, 2)) : fmin(ratio, nextafter(1, 0));
}

static bool is_finite(const octree_point *point)
{
    return isfinite(point->position[0]) && isfinite(point->position[1]) && isfinite(point->position[2]);
}

/* Drop unknown ids, points that occur again, and points that are not finite. The points that remain are marked in
 * `named`. Returns their number. */
static size_t take_known(const octree_point *points, size_t count, const uint64_t *ids, size_t id_count, bool *named,
                         const octree_point **known)
{
    size_t kept = 0;
    for (size_t i = 0; i < id_count; i++)
        if (ids[i] < count && !named[ids[i]] && is_finite(&points[ids[i]])) {
            named[ids[i]] = true;
            known[kept++] = &points[ids[i]];
        }
    return kept;
}

/* ---- Neighbours --------------------------------------------------------------------------------------------- */

/* Sort by distance; the lists are short. */
static void sort_by_distance(const double target[3], const octree_point **list, size_t count)
{
    for (size_t i = 1; i < count; i++)
        for (size_t j = i; j > 0 && quick_compare(target, list[j - 1]->position, list[j]->position) > 0; j--) {
            const octree_point *swapped = list[j];
            list[j] = list[j - 1];
            list[j - 1] = swapped;
        }
}

static void judge_neighbors(const octree_query *query, const octree_point *const *nearest, const octree_point **known,
                            size_t known_count, answer_error *error)
{
    error->ratio = 1;
    error->extra = known_count > error->expected ? known_count - error->expected : 0;
    sort_by_distance(query->target, known, known_count);
    for (size_t i = 0; i < error->expected; i++) {
        const double ratio =
            i < known_count ? distance_ratio(query->target, known[i]->position, nearest[i]->position) : INFINITY;
        error->missing += ratio > 1;
        error->ratio = fmax(error->ratio, ratio);
        error->ratio_sum += i < known_count ? ratio : 0;
    }
}

/* The finite points, whose nearest are searched. */
static size_t list_nearest(const octree_query *query, const octree_point *points, size_t count, size_t k,
                           const octree_point **nearest)
{
    octree_point *finite = malloc((count + 1) * sizeof *finite);
    size_t finite_count = 0;
    if (!finite)
        abort();
    for (size_t i = 0; i < count; i++)
        if (is_finite(&points[i]))
            finite[finite_count++] = points[i];
    const size_t found = k < finite_count ? k : finite_count;
    quick_nearest_k(finite, finite_count, query->target, found, nearest);
    for (size_t i = 0; i < found; i++)
        nearest[i] = &points[nearest[i]->id];
    free(finite);
    return found;
}

/* ---- Regions ------------------------------------------------------------------------------------------------ */

/* -1: inside; 0: exactly on the boundary; 1: outside, or not a number. */
static int side_of_box(const octree_box *box, const double at[3])
{
    int side = -1;
    for (int axis = 0; axis < 3; axis++) {
        if (!(at[axis] >= box->min[axis] && at[axis] <= box->max[axis]))
            return 1;
        if (at[axis] == box->min[axis] || at[axis] == box->max[axis])
            side = 0;
    }
    return side;
}

static int side_of(const octree_query *query, const octree_point *point)
{
    if (!is_finite(point))
        return 1;
    return query->kind == OCTREE_QUERY_RANGE ? side_of_box(&query->box, point->position)
                                             : quick_compare_radius(query->target, point->position, query->radius, 0);
}

static void judge_region(const octree_query *query, const octree_point *points, size_t count, const bool *named,
                         answer_error *error)
{
    size_t missing_on_boundary = 0;
    for (size_t i = 0; i < count; i++) {
        const int side = side_of(query, &points[i]);
        error->expected += side <= 0;
        error->missing += side <= 0 && !named[i];
        error->extra += side > 0 && named[i];
        missing_on_boundary += side == 0 && !named[i];
    }
    error->ratio = 1;
    error->boundary = error->missing > 0 && error->missing == missing_on_boundary;
}

answer_error find_answer_error(const octree_query *query, const octree_point *points, size_t count, const uint64_t *ids,
                               size_t id_count, const octree_point *const *nearest)
{
    const octree_point *found[QUICK_NEAREST_MOST];
    answer_error error = {0};
    bool *named = calloc(count + 1, sizeof *named);
    const octree_point **known = malloc((id_count + 1) * sizeof *known);
    if (!named || !known)
        abort();
    const size_t known_count = take_known(points, count, ids, id_count, named, known);
    error.unknown = id_count - known_count;
    if (!octree_query_about(query->kind)->neighbors)
        judge_region(query, points, count, named, &error);
    else {
        const size_t k = query->kind == OCTREE_QUERY_NEAREST ? 1 : query->k;
        error.expected = nearest ? k : list_nearest(query, points, count, k, found);
        judge_neighbors(query, nearest ? nearest : found, known, known_count, &error);
    }
    free(named);
    free(known);
    return error;
}

bool is_right(const answer_error *error)
{
    return error->missing == 0 && error->extra == 0 && error->unknown == 0;
}
