/* SPDX-License-Identifier: MIT */
#include "brute.h"

#include <math.h>
#include <stdlib.h>

#include "fixture.h"

void brute_free(brute *all)
{
    free(all->points);
    *all = (brute){0};
}

void brute_insert(brute *all, const double position[3], uint64_t id)
{
    if (all->count == all->capacity) {
        all->capacity = all->capacity == 0 ? 64 : 2 * all->capacity;
        octree_point *points = realloc(all->points, all->capacity * sizeof *points);
        assert_non_null(points);
        all->points = points;
    }
    all->points[all->count++] = (octree_point){{position[0], position[1], position[2]}, id};
}

void brute_scatter(brute *all, uint64_t *random, size_t count, uint64_t reach, uint64_t ids)
{
    for (size_t i = 0; i < count; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = (double)random_below(random, 2 * reach + 1) - (double)reach;
        uint64_t id = random_below(random, ids);
        if (!brute_contains(all, at, id))
            brute_insert(all, at, id);
    }
}

void brute_sample(brute *all, octree_sample_kind kind, uint64_t seed, const octree_box *box, size_t count)
{
    double(*positions)[3] = malloc(count * sizeof *positions);
    assert_non_null(positions);
    assert_int_equal(octree_sample(kind, seed, box, count, positions), OCTREE_OK);
    for (size_t i = 0; i < count; i++)
        brute_insert(all, positions[i], i);
    free(positions);
}

octree *brute_tree(const brute *all, octree_box world, size_t capacity, size_t depth)
{
    octree *tree = make_tree(world, capacity, depth, OCTREE_GROW);
    for (size_t i = 0; i < all->count; i++)
        assert_int_equal(octree_insert(tree, all->points[i].position, all->points[i].id), OCTREE_OK);
    return tree;
}

static size_t index_of(const brute *all, const double position[3], uint64_t id)
{
    size_t i = 0;
    while (i < all->count && !(all->points[i].id == id && same_position(all->points[i].position, position)))
        i++;
    return i;
}

bool brute_remove(brute *all, const double position[3], uint64_t id)
{
    size_t i = index_of(all, position, id);
    if (i == all->count)
        return false;
    all->points[i] = all->points[--all->count];
    return true;
}

bool brute_contains(const brute *all, const double position[3], uint64_t id)
{
    return index_of(all, position, id) < all->count;
}

bool brute_find(const brute *all, const double position[3], uint64_t *id)
{
    bool found = false;
    for (size_t i = 0; i < all->count; i++) {
        const octree_point *point = &all->points[i];
        if (!same_position(point->position, position) || (found && point->id > *id))
            continue;
        *id = point->id;
        found = true;
    }
    return found;
}

void brute_range(const brute *all, const octree_box *box, brute *found)
{
    for (size_t i = 0; i < all->count; i++)
        if (box_holds(box, all->points[i].position))
            brute_collect(&all->points[i], found);
}

bool brute_is_within(double center, double size, double p)
{
    double high = fmax(center, p);
    double low = fmin(center, p);
    double distance = high - low;
    if (distance != size)
        return distance < size; /* rounding is monotone, so it cannot carry the distance past a double */
    /* The part that rounding took off the distance (Dekker's Fast2Sum, which does not overflow as TwoSum does). */
    double lost = fabs(high) >= fabs(low) ? -low - (distance - high) : high - (distance + low);
    return lost <= 0;
}

void brute_collide(const brute *all, const double center[3], double size, const octree_point *self, brute *found)
{
    for (size_t i = 0; i < all->count; i++) {
        const octree_point *point = &all->points[i];
        if (self != NULL && self->id == point->id && same_position(self->position, point->position))
            continue;
        bool within = true;
        for (int axis = 0; axis < 3; axis++)
            within = within && brute_is_within(center[axis], size, point->position[axis]);
        if (within)
            brute_collect(point, found);
    }
}

/* Whether, relative to the box, a point that goes from u to w is within `sizes` after num / den of the way. */
static bool is_within_at(const double u[3], const double w[3], const double sizes[3], double num, double den)
{
    for (int axis = 0; axis < 3; axis++)
        if (fabs(u[axis] * (den - num) + w[axis] * num) > sizes[axis] * den)
            return false;
    return true;
}

/* The moments of touching are a closed interval: were there any, its first would be 0 or the moment when the box
 * arrives at the point on one of the axes. */
bool brute_touches_box(const double from[3], const double to[3], const double sizes[3], const double p[3],
                       const double q[3])
{
    double u[3], w[3];
    for (int axis = 0; axis < 3; axis++) {
        u[axis] = p[axis] - from[axis];
        w[axis] = q[axis] - to[axis];
    }
    if (is_within_at(u, w, sizes, 0, 1))
        return true;
    for (int axis = 0; axis < 3; axis++) {
        const double way = u[axis] - w[axis];
        const double num = (way > 0 ? u[axis] : -u[axis]) - sizes[axis], den = fabs(way);
        if (den > 0 && num >= 0 && num <= den && is_within_at(u, w, sizes, num, den))
            return true;
    }
    return false;
}

bool brute_touches(const double from[3], const double to[3], double size, const double p[3], const double q[3])
{
    return brute_touches_box(from, to, (double[]){size, size, size}, p, q);
}

bool brute_is_skipped(const octree_point *point, const double target[3], octree_skip skip, uint64_t skip_id)
{
    return (skip == OCTREE_SKIP_ID && point->id == skip_id) ||
           (skip == OCTREE_SKIP_COINCIDENT && same_position(point->position, target));
}

static double squared_distance(const double a[3], const double b[3])
{
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

bool brute_nearest(const brute *all, const double target[3], octree_skip skip, uint64_t skip_id,
                   octree_neighbor *nearest)
{
    const octree_point *best = NULL;
    double least = INFINITY;
    for (size_t i = 0; i < all->count; i++) {
        const octree_point *point = &all->points[i];
        if (brute_is_skipped(point, target, skip, skip_id))
            continue;
        double squared = squared_distance(point->position, target);
        if (best == NULL || squared < least || (squared == least && point->id < best->id)) {
            best = point;
            least = squared;
        }
    }
    if (best != NULL)
        *nearest = (octree_neighbor){*best, sqrt(least)};
    return best != NULL;
}

static int by_id_then_position(const void *left, const void *right)
{
    const octree_point *a = left;
    const octree_point *b = right;
    if (a->id != b->id)
        return a->id < b->id ? -1 : 1;
    for (int axis = 0; axis < 3; axis++)
        if (a->position[axis] != b->position[axis])
            return a->position[axis] < b->position[axis] ? -1 : 1;
    return 0;
}

void brute_radius(const brute *all, const double center[3], double radius, brute *found)
{
    for (size_t i = 0; i < all->count; i++)
        if (squared_distance(all->points[i].position, center) <= radius * radius)
            brute_collect(&all->points[i], found);
}

/* By the square that `distance` holds, then as points. */
static int by_square(const void *left, const void *right)
{
    const octree_neighbor *a = left;
    const octree_neighbor *b = right;
    if (a->distance != b->distance)
        return a->distance < b->distance ? -1 : 1;
    return by_id_then_position(&a->point, &b->point);
}

size_t brute_nearest_k(const brute *all, const double target[3], size_t k, octree_skip skip, uint64_t skip_id,
                       octree_neighbor **nearest)
{
    octree_neighbor *sorted = calloc(all->count + 1, sizeof *sorted);
    assert_non_null(sorted);
    size_t count = 0;
    for (size_t i = 0; i < all->count; i++) {
        const octree_point *point = &all->points[i];
        if (!brute_is_skipped(point, target, skip, skip_id))
            sorted[count++] = (octree_neighbor){*point, squared_distance(point->position, target)};
    }
    qsort(sorted, count, sizeof *sorted, by_square);
    for (size_t i = 0; i < count; i++)
        sorted[i].distance = sqrt(sorted[i].distance);
    *nearest = sorted;
    return count < k ? count : k;
}

bool brute_collect(const octree_point *point, void *context)
{
    brute_insert(context, point->position, point->id);
    return true;
}

static void sort(brute *all)
{
    if (all->count > 1)
        qsort(all->points, all->count, sizeof *all->points, by_id_then_position);
}

bool brute_equal(brute *a, brute *b)
{
    if (a->count != b->count)
        return false;
    sort(a);
    sort(b);
    for (size_t i = 0; i < a->count; i++)
        if (by_id_then_position(&a->points[i], &b->points[i]) != 0)
            return false;
    return true;
}
