/* SPDX-License-Identifier: MIT */
/* filter.h - which nodes and points of a tree a view shows.
 *
 * A node is shown when it passes every part of the filter:
 *   slice    the plane runs through its cell, by the rule that places points: min <= at < max, where the world's
 *            greatest face belongs to the last cell. So a slice is one layer of cells, also where it lies on a plane
 *            of the tree.
 *   depth    its depth is in the range.
 *   leaves   it is a leaf.
 *   region   its box meets the region; both are closed.
 * A point is shown when it lies in the region, in a leaf that the slice's plane runs through, and in some node of the
 * range of depths: that is, in a leaf at least as deep as the range begins; of leaves alone, in one of the range.
 */
#ifndef SCENE_FILTER_H
#define SCENE_FILTER_H

#include "octree/types.h"

#include <stdbool.h>

/* All zero shows the whole tree. */
typedef struct view_filter {
    char slice;                    /* 'x', 'y' or 'z': the nodes that cut a plane across this axis; 0: all */
    double slice_at;               /* where the plane is */
    bool by_depth;                 /* only nodes from min_depth to max_depth */
    unsigned min_depth, max_depth; /* 0 to OCTREE_MAX_DEPTH */
    bool leaves;                   /* only leaves */
    bool by_region;                /* only what meets a closed box */
    octree_box region;
} view_filter;

/* Whether a node's box is shown. `world` is the tree's. */
bool filter_shows_node(const view_filter *f, const octree_box *world, const octree_node *node);

/* Whether a node or anything below it may be shown: slice and region cut off whole branches. */
bool filter_enters(const view_filter *f, const octree_box *world, const octree_node *node);

/* Whether a box of a program's own tree is shown. The slice's plane is then to meet the closed box, which may be flat;
 * and a range of depths that ends at OCTREE_MAX_DEPTH has no end. */
bool filter_shows_box(const view_filter *f, const octree_box *box, unsigned depth, bool leaf);

/* Whether a leaf's points may be shown, judged by the leaf alone; and then one of its points. */
bool filter_shows_points_of(const view_filter *f, const octree_box *world, const octree_node *leaf);
bool filter_shows_point(const view_filter *f, const double position[3]);

/* Whether a filter leaves anything out at all. */
bool filter_is_on(const view_filter *f);

/* Null when a filter can show something of a tree of this world and depth; else the reason, one sentence, in `text`. */
#define FILTER_TEXT 256
const char *filter_refusal(const view_filter *f, const octree_def *tree, char text[FILTER_TEXT]);

#endif
