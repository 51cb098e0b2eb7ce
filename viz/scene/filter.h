/* SPDX-License-Identifier: MIT */
/* filter.h - which nodes and points of a tree a view shows.
 *
 * A node is shown if it passes every part of the filter that is set:
 *   slice    The slice's plane runs through the node's cell. A cell is half-open, as for points: min <= at < max; only
 *            the last cell contains the world's greatest face. So a slice is one layer of cells, even where its plane
 *            is also a splitting plane of the tree.
 *   depth    The node's depth is in the range of depths.
 *   leaves   The node is a leaf.
 *   region   The node's box and the region intersect or touch.
 *
 * A point is shown if it lies in the region, and its leaf passes these tests:
 *   slice    The slice's plane runs through the leaf's cell.
 *   depth    The leaf is at least as deep as the least depth of the range. A deeper leaf passes, too, because one of
 *            its ancestors is in the range.
 *   leaves   The leaf itself is in the range of depths.
 */
#ifndef SCENE_FILTER_H
#define SCENE_FILTER_H

#include "octree/types.h"

#include <stdbool.h>

/* Selects the nodes and points that a view shows. A zeroed filter selects the whole tree. */
typedef struct view_filter {
    char slice;      /* 'x', 'y' or 'z': show only nodes that a plane normal to this axis cuts; 0: no plane */
    double slice_at; /* the plane's coordinate on the axis `slice` */
    bool by_depth;   /* true: show only nodes whose depth is from min_depth to max_depth */
    unsigned min_depth, max_depth; /* limits of the range of depths, each from 0 to OCTREE_MAX_DEPTH */
    bool leaves;                   /* true: show only leaves */
    bool by_region;                /* true: show only nodes and points in or at the box `region` */
    octree_box region;
} view_filter;

/* Returns whether the view shows a node's box. `world` is the tree's box. */
bool filter_shows_node(const view_filter *f, const octree_box *world, const octree_node *node);

/* Returns whether the view may show a node or any of its descendants. The slice and the region exclude whole
 * subtrees. */
bool filter_shows_subtree(const view_filter *f, const octree_box *world, const octree_node *node);

/* Returns whether the view shows a foreign node's box. Unlike the cell of a node of Octreel's tree, a foreign box
 * contains all its faces and may be flat: the view also shows the box if the slice's plane only touches it. A range of
 * depths that ends at OCTREE_MAX_DEPTH includes all greater depths. */
bool filter_shows_box(const view_filter *f, const octree_box *box, unsigned depth, bool leaf);

/* The view shows a point if filter_shows_points_of() returns true for the point's leaf, and filter_shows_point()
 * returns true for the point's position. */
bool filter_shows_points_of(const view_filter *f, const octree_box *world, const octree_node *leaf);
bool filter_shows_point(const view_filter *f, const double position[3]);

/* Returns whether the filter has a slice, a range of depths, `leaves` or a region. */
bool filter_is_set(const view_filter *f);

/* Returns null if the filter can show some node of a tree with this world and maximum depth. Otherwise returns `text`,
 * which then explains in a sentence why the filter shows no node. */
#define FILTER_TEXT 256
const char *filter_find_problem(const view_filter *f, const octree_def *tree, char text[FILTER_TEXT]);

#endif
