/* fit.c - see fit.h. */
#include "fit.h"
#include "filter.h"

#include <float.h>
#include <math.h>

/* Of the longest side: a box that is thinner is widened to it, so that points on a line or a plane are seen in a piece
 * of their surroundings from any side. */
#define THINNEST (1.0 / 16)

typedef struct bounds {
    const view_filter *filter;
    octree_box world, box;
    size_t count;
} bounds;

static void take_in(bounds *b, const double position[3])
{
    for (int i = 0; i < 3; i++) {
        b->box.min[i] = b->count == 0 || position[i] < b->box.min[i] ? position[i] : b->box.min[i];
        b->box.max[i] = b->count == 0 || position[i] > b->box.max[i] ? position[i] : b->box.max[i];
    }
    b->count++;
}

static octree_walk_order measure_node(const octree_node *node, void *context)
{
    bounds *b = context;
    if (!filter_enters(b->filter, &b->world, node))
        return OCTREE_WALK_SKIP;
    if (!node->leaf || !filter_shows_points_of(b->filter, &b->world, node))
        return OCTREE_WALK_ON;
    for (size_t i = 0; i < node->count; i++)
        if (filter_shows_point(b->filter, node->points[i].position))
            take_in(b, node->points[i].position);
    return OCTREE_WALK_ON;
}

/* Halves of extents, since extents can overflow. */
static double half_of(const octree_box *box, int axis)
{
    return box->max[axis] / 2 - box->min[axis] / 2;
}

static void widen(octree_box *box)
{
    double longest = 0;
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, half_of(box, i));
    for (int i = 0; i < 3; i++) {
        const double slack = longest * THINNEST - half_of(box, i);
        if (slack <= 0)
            continue;
        box->min[i] = fmax(box->min[i] - slack, -DBL_MAX);
        box->max[i] = fmin(box->max[i] + slack, DBL_MAX);
    }
}

static bool is_a_place(const octree_box *box)
{
    return box->min[0] == box->max[0] && box->min[1] == box->max[1] && box->min[2] == box->max[2];
}

void fit_view(view *v, const octree *tree)
{
    if (v->fit != FIT_POINTS)
        return;
    bounds b = {.filter = &v->filter, .world = octree_definition(tree).world};
    octree_walk(tree, measure_node, &b);
    v->fit = b.count ? FIT_BOX : FIT_WORLD;
    octree_node leaf;
    if (b.count && is_a_place(&b.box) && octree_locate(tree, b.box.min, &leaf) == OCTREE_OK)
        b.box = leaf.box;
    widen(&b.box);
    v->focus = b.box;
}
