/* SPDX-License-Identifier: MIT */
/* node_boxes.h - adds boxes of nodes, for the layers that show nodes, and selects the points to drop if there are more
 * points than the budget. */
#ifndef LAYERS_NODE_BOXES_H
#define LAYERS_NODE_BOXES_H

#include "filter.h"
#include "octree/digest.h"
#include "scene.h"

/* The facts about a node that its colour can show. */
typedef struct node_traits {
    unsigned depth;
    size_t points;
    size_t capacity; /* maximum number of points in a leaf of the node's tree; 0: unlimited, as in a foreign index */
    bool leaf;
} node_traits;

/* Return the colour role of a node. Under COLORING_OCCUPANCY the inner nodes of a tree with a capacity are grey. Every
 * inner node holds more points than the capacity, so its colour would say nothing, and coloured boxes of inner nodes
 * would hide the leaves. */
theme_role node_role(const view *v, node_traits node);

/* Add the box of a node. The element's id is the node's address. */
void add_node_box(scene *s, const octree_node *node, scene_style style);

/* Return whether a box is smaller than the view's lod and belongs to a node with an ancestor that the filter shows.
 * Every query that visits a node also visits the node's ancestors. So a layer of visited nodes that leaves out the node
 * still shows this ancestor. */
bool is_left_out_by_lod(const scene *s, const octree_box *box, unsigned depth);

/* Return whether a filter shows a point at a position: it shows the position and its leaf. */
bool is_position_shown(const view_filter *f, const octree *tree, const octree_box *world, const double position[3]);

/* Find the node at an address. If the tree no longer has the node, *node becomes its empty cell. Return false if the
 * scene must not show the node: the view's filter hides it, or it is smaller than the view's lod and an ancestor is
 * shown. Nodes that are too small are counted in tally.small_marked. */
bool find_shown_node(scene *s, const octree *tree, octree_address address, octree_node *node);

/* Add the diagonals of a box's six faces, as lines with the ids 0 to CROSS_LINES - 1. Readers recognize a box with
 * crossed faces even without colour. */
void add_crossed_faces(scene *s, const octree_box *box, scene_style style);
#define CROSS_LINES 12

/* Return whether a sieve drops an id. A sieve is a bit mask that decides which points are dropped if there are more
 * points than the budget. The decision depends only on the point's id. So a moving point does not flicker, and a point
 * and its velocity arrow are dropped together. A sieve whose n lowest bits are set keeps about one id in 2^n. A sieve
 * with more bits, called finer, keeps a subset of the ids that a coarser sieve keeps. */
static inline bool sieve_rejects_id(uint64_t sieve, uint64_t id)
{
    return octree_digest_word(OCTREE_DIGEST_START, id) & sieve;
}

static inline uint64_t make_finer_sieve(uint64_t sieve)
{
    return sieve << 1 | 1;
}

#endif
