/* SPDX-License-Identifier: MIT */
/* filter.c - tests nodes and points against a view filter; filter.h states the rules. */
#include "filter.h"
#include "number.h"

#include <stdio.h>

static bool does_slice_cut(const view_filter *f, const octree_box *world, const octree_box *box)
{
    const int axis = f->slice - 'x';
    const double at = f->slice_at, max = box->max[axis];
    return box->min[axis] <= at && (at < max || (at == max && max == world->max[axis]));
}

static bool do_boxes_intersect(const octree_box *a, const octree_box *b)
{
    for (int i = 0; i < 3; i++)
        if (a->max[i] < b->min[i] || b->max[i] < a->min[i])
            return false;
    return true;
}

bool filter_shows_subtree(const view_filter *f, const octree_box *world, const octree_node *node)
{
    return (!f->slice || does_slice_cut(f, world, &node->box)) &&
           (!f->by_region || do_boxes_intersect(&f->region, &node->box));
}

bool filter_shows_node(const view_filter *f, const octree_box *world, const octree_node *node)
{
    if (f->leaves && !node->leaf)
        return false;
    if (f->by_depth && (node->depth < f->min_depth || node->depth > f->max_depth))
        return false;
    return filter_shows_subtree(f, world, node);
}

bool filter_shows_box(const view_filter *f, const octree_box *box, unsigned depth, bool leaf)
{
    const int axis = f->slice - 'x';
    if (f->leaves && !leaf)
        return false;
    if (f->by_depth && (depth < f->min_depth || (depth > f->max_depth && f->max_depth < OCTREE_MAX_DEPTH)))
        return false;
    if (f->slice && !(box->min[axis] <= f->slice_at && f->slice_at <= box->max[axis]))
        return false;
    return !f->by_region || do_boxes_intersect(&f->region, box);
}

bool filter_shows_points_of(const view_filter *f, const octree_box *world, const octree_node *leaf)
{
    const bool in_depth = leaf->depth >= f->min_depth && (!f->leaves || leaf->depth <= f->max_depth);
    return (!f->by_depth || in_depth) && filter_shows_subtree(f, world, leaf);
}

bool filter_shows_point(const view_filter *f, const double position[3])
{
    for (int i = 0; f->by_region && i < 3; i++)
        if (position[i] < f->region.min[i] || position[i] > f->region.max[i])
            return false;
    return true;
}

bool filter_is_set(const view_filter *f)
{
    return f->slice || f->by_depth || f->leaves || f->by_region;
}

static const char *find_slice_problem(const view_filter *f, const octree_box *world, char text[FILTER_TEXT])
{
    const int axis = f->slice - 'x';
    char at[NUMBER_TEXT], min[NUMBER_TEXT], max[NUMBER_TEXT];
    if (f->slice_at >= world->min[axis] && f->slice_at <= world->max[axis])
        return NULL;
    snprintf(text, FILTER_TEXT, "the slice %c = %s lies outside the world, which extends from %s to %s on this axis",
             f->slice, number_format(f->slice_at, 9, at), number_format(world->min[axis], 9, min),
             number_format(world->max[axis], 9, max));
    return text;
}

static const char *find_region_problem(const view_filter *f, const octree_box *world, char text[FILTER_TEXT])
{
    for (int i = 0; i < 3; i++) {
        char from[NUMBER_TEXT], to[NUMBER_TEXT], min[NUMBER_TEXT], max[NUMBER_TEXT];
        if (f->region.max[i] >= world->min[i] && f->region.min[i] <= world->max[i])
            continue;
        snprintf(text, FILTER_TEXT,
                 "the region lies outside the world: on axis %c the region extends from %s to %s, and the world from "
                 "%s to %s",
                 "xyz"[i], number_format(f->region.min[i], 9, from), number_format(f->region.max[i], 9, to),
                 number_format(world->min[i], 9, min), number_format(world->max[i], 9, max));
        return text;
    }
    return NULL;
}

const char *filter_find_problem(const view_filter *f, const octree_def *tree, char text[FILTER_TEXT])
{
    const char *reason = f->slice ? find_slice_problem(f, &tree->world, text) : NULL;
    if (!reason && f->by_region)
        reason = find_region_problem(f, &tree->world, text);
    if (reason || !f->by_depth || f->min_depth <= tree->max_depth)
        return reason;
    snprintf(text, FILTER_TEXT, "the range of depths begins at %u, but the deepest level of the tree is %zu",
             f->min_depth, tree->max_depth);
    return text;
}
