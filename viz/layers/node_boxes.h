/* SPDX-License-Identifier: MIT */
/* node_boxes.h - boxes of nodes, for the layers that show some of them; and how too many points are thinned out. */
#ifndef LAYERS_NODE_BOXES_H
#define LAYERS_NODE_BOXES_H

#include "octree/digest.h"
#include "scene.h"

/* What the colour of a node may tell. */
typedef struct node_traits {
    unsigned depth;
    size_t points;
    size_t capacity; /* of the leaves of its tree; 0: it has none, as that of a program */
    bool leaf;
} node_traits;

/* Under COLORING_OCCUPANCY inner nodes of a tree with a capacity, which all hold more than that, are not on the scale:
 * they would hide the leaves. */
theme_role node_role(const view *v, node_traits node);

/* A node's box, with its address as id. */
void add_node_box(scene *s, const octree_node *node, scene_style style);

/* The node at an address of a tick, or its empty cell when the tree no longer has the node. False when the view's
 * filter hides it, or when it is smaller than the view's lod and lies in a node that is shown, which is counted. */
bool find_shown_node(scene *s, const octree *tree, octree_address address, octree_node *node);

/* The diagonals of a box's six faces, with ids from 0 to CROSS_LINES - 1: recognizable without colour.
 */
void add_crossed_faces(scene *s, const octree_box *box, scene_style style);
#define CROSS_LINES 12

/* Thinning of points to the budget goes by the id alone, so that a moving point does not flicker and its velocity is
 * dropped with it. A sieve whose n lowest bits are set keeps about one id in 2^n; a finer sieve keeps a subset. */
static inline bool sieve_drops(uint64_t sieve, uint64_t id)
{
    return octree_digest_word(OCTREE_DIGEST_START, id) & sieve;
}

static inline uint64_t finer_sieve(uint64_t sieve)
{
    return sieve << 1 | 1;
}

#endif
