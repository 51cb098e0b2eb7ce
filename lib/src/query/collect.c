/* collect.c - the points of a range in an array of the caller's. */
#include "octree/octree.h"

#include <stdlib.h>

typedef struct collection {
    octree_point *points;
    size_t room, count;
} collection;

static bool collect(const octree_point *point, void *context)
{
    collection *c = context;
    if (c->count < c->room)
        c->points[c->count] = *point;
    c->count++;
    return true;
}

/* Let the largest, on top of a heap of points, sink to its place. */
static void sink(octree_point *heap, size_t count)
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

static void swap_ends(octree_point *points, size_t count)
{
    for (size_t i = 0; i < count / 2; i++) {
        const octree_point kept = points[i];
        points[i] = points[count - 1 - i];
        points[count - 1 - i] = kept;
    }
}

/* Keep the least. When the room is full it becomes a heap (descending order is one), and what is less than its top
 * takes the top's place. */
static bool collect_least(const octree_point *point, void *context)
{
    collection *c = context;
    c->count++;
    if (c->count <= c->room) {
        c->points[c->count - 1] = *point;
        if (c->count == c->room) {
            qsort(c->points, c->room, sizeof *c->points, octree_compare_points);
            swap_ends(c->points, c->room);
        }
    } else if (c->room > 0 && octree_compare_points(point, &c->points[0]) < 0) {
        c->points[0] = *point;
        sink(c->points, c->room);
    }
    return true;
}

static octree_status run(const octree *tree, const octree_box *box, const octree_search *how,
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
    return run(tree, box, how, collect, points, room, count);
}

octree_status octree_range_collect_sorted(const octree *tree, const octree_box *box, const octree_search *how,
                                          octree_point *points, size_t room, size_t *count)
{
    const octree_status status = run(tree, box, how, collect_least, points, room, count);
    const size_t stored = !count ? 0 : *count < room ? *count : room;
    if (stored > 1)
        qsort(points, stored, sizeof *points, octree_compare_points);
    return status;
}
