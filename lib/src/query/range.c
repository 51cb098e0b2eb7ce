/* SPDX-License-Identifier: MIT */
/* range.c - range search in a closed box (Algorithm 4), and collision as a range search (Algorithm 5). */
#include "../exact/float_mode.h"
#include "../exact/exact.h"
#include "region.h"

#include <stdlib.h>

/* Returns the box with its faces moved outwards by epsilon. The faces are rounded inwards, so that a point that is
 * farther than epsilon from the box on any axis is never inside. */
static octree_box widen_box(const octree_box *box, double epsilon)
{
    octree_box wide;
    for (int i = 0; i < 3; i++) {
        wide.min[i] = isfinite(box->min[i]) ? exact_add_up(box->min[i], -epsilon) : box->min[i];
        wide.max[i] = isfinite(box->max[i]) ? exact_add_down(box->max[i], epsilon) : box->max[i];
    }
    return wide;
}

/* Visit the points in a valid box, or count them if `visit` is null. Returns the count. */
static size_t visit_or_count_box(const octree *tree, const octree_box *box, const octree_search *how,
                                 octree_point_visitor visit, void *context)
{
    const octree_box wide = widen_box(box, how->epsilon);
    box_shape shape = box_shape_make(tree, box, how->epsilon > 0 ? &wide : box);
    region r = {tree, &shape, box_shape_enter, box_shape_scan, visit, context, .meter.how = how};
    region_search(&r, box_shape_root(&shape, tree));
    return r.count;
}

octree_status octree_range_search(const octree *tree, const octree_box *box, const octree_search *how,
                                  octree_point_visitor visit, void *context)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_range_search, tree, box, CALLER_SEARCH(how),
                           CALLER_VISITOR(visit, context));
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    const octree_search search = search_or_default(how);
    octree_status status = check_box(box);
    if (status == OCTREE_OK)
        status = check_search_options(&search);
    if (status == OCTREE_OK)
        visit_or_count_box(tree, box, &search, visit, context);
    return status;
}

octree_status octree_range(const octree *tree, const octree_box *box, octree_point_visitor visit, void *context)
{
    return octree_range_search(tree, box, NULL, visit, context);
}

octree_status octree_range_count(const octree *tree, const octree_box *box, size_t *count)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_range_count, tree, box, count);
    if (!count)
        return OCTREE_NULL_ARGUMENT;
    *count = 0;
    const octree_status status = tree ? check_box(box) : OCTREE_NULL_ARGUMENT;
    if (status == OCTREE_OK)
        *count = visit_or_count_box(tree, box, &(octree_search){0}, NULL, NULL);
    return status;
}

/* ---- Results in an array ------------------------------------------------------------------------------------- */

typedef struct collection {
    octree_point *points;
    size_t room, count;
} collection;

static bool collect_first(const octree_point *point, void *context)
{
    collection *c = context;
    if (c->count < c->room)
        c->points[c->count] = *point;
    c->count++;
    return true;
}

/* Restore the order of a heap with the greatest point on top, after the top was replaced. */
static void sink_in_heap(octree_point *heap, size_t count)
{
    for (size_t at = 0, child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && octree_compare_points(&heap[child], &heap[child + 1]) < 0)
            child++;
        if (octree_compare_points(&heap[at], &heap[child]) >= 0)
            return;
        const octree_point kept = heap[at];
        heap[at] = heap[child];
        heap[child] = kept;
    }
}

static int compare_reversed(const void *a, const void *b)
{
    return octree_compare_points(b, a);
}

/* An octree_point_visitor: keep the `room` smallest points. When the array becomes full, it is sorted in descending
 * order, so that it is a heap with the greatest point on top. From then on, a point that is smaller than the top
 * replaces the top. */
static bool collect_smallest(const octree_point *point, void *context)
{
    collection *c = context;
    c->count++;
    if (c->count <= c->room) {
        c->points[c->count - 1] = *point;
        if (c->count == c->room)
            qsort(c->points, c->room, sizeof *c->points, compare_reversed);
    } else if (c->room > 0 && octree_compare_points(point, &c->points[0]) < 0) {
        c->points[0] = *point;
        sink_in_heap(c->points, c->room);
    }
    return true;
}

static octree_status collect_in_array(const octree *tree, const octree_box *box, const octree_search *how,
                                      octree_point_visitor visit, octree_point *points, size_t room, size_t *count)
{
    if (!count)
        return OCTREE_NULL_ARGUMENT;
    *count = 0;
    if (!points && room)
        return OCTREE_NULL_ARGUMENT;
    collection c = {points, room, 0};
    const octree_status status = octree_range_search(tree, box, how, visit, &c);
    *count = c.count;
    return status;
}

octree_status octree_range_collect(const octree *tree, const octree_box *box, const octree_search *how,
                                   octree_point *points, size_t room, size_t *count)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_range_collect, tree, box, CALLER_SEARCH(how), points, room, count);
    return collect_in_array(tree, box, how, collect_first, points, room, count);
}

octree_status octree_range_collect_sorted(const octree *tree, const octree_box *box, const octree_search *how,
                                          octree_point *points, size_t room, size_t *count)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_range_collect_sorted, tree, box, CALLER_SEARCH(how), points, room,
                           count);
    const octree_status status = collect_in_array(tree, box, how, collect_smallest, points, room, count);
    const size_t stored = !count ? 0 : *count < room ? *count : room;
    if (stored > 1)
        qsort(points, stored, sizeof *points, octree_compare_points);
    return status;
}

/* ---- Algorithm 5 -------------------------------------------------------------------------------------------- */

octree_status octree_collision_box(const double center[3], double box_size, octree_box *box)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_collision_box, center, box_size, box);
    if (!center || !box)
        return OCTREE_NULL_ARGUMENT;
    octree_status status = check_finite_position(center);
    if (status == OCTREE_OK)
        status = check_length(box_size);
    for (int i = 0; status == OCTREE_OK && i < 3; i++) {
        const double middle = center[i]; /* read before *box is written: `center` may point into *box */
        box->min[i] = exact_add_up(middle, -box_size);
        box->max[i] = exact_add_down(middle, box_size);
    }
    return status;
}

octree_status octree_collide_search(const octree *tree, const double center[3], double box_size,
                                    const octree_point *self, const octree_search *how, octree_point_visitor visit,
                                    void *context)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_collide_search, tree, center, box_size, self, CALLER_SEARCH(how),
                           CALLER_VISITOR(visit, context));
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    octree_box box;
    const octree_status status = octree_collision_box(center, box_size, &box);
    if (status != OCTREE_OK)
        return status;
    return octree_range_search(tree, &box, how, visit_unless_self, &(collision){self, visit, context});
}

octree_status octree_collide(const octree *tree, const double center[3], double box_size, const octree_point *self,
                             octree_point_visitor visit, void *context)
{
    return octree_collide_search(tree, center, box_size, self, NULL, visit, context);
}
