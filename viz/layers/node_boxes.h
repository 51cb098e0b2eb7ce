/* SPDX-License-Identifier: MIT */
/* node_boxes.h - draws boxes of nodes, for the layers that show nodes, and thins out points beyond the budget. */
#ifndef LAYERS_NODE_BOXES_H
#define LAYERS_NODE_BOXES_H

#include "octree/digest.h"
#include "scene.h"

/* The facts about a node that its colour can show. */
typedef struct node_traits {
    unsigned depth;
    size_t points;
    size_t capacity; /* points that a leaf of its tree can hold; 0: unlimited, as in a foreign index */
    bool leaf;
} node_traits;

/* Return the colour role of a node. Under COLORING_OCCUPANCY the inner nodes of a tree with a capacity are grey: they
 * all hold more points than the capacity, and their boxes would hide the leaves. */
theme_role node_role(const view *v, node_traits node);

/* Add a node's box, with the node's address as id. */
void add_node_box(scene *s, const octree_node *node, scene_style style);

/* Whether a node is smaller than the view's lod and has an ancestor that the filter shows. A tick that visits a node
 * also visits its ancestors, so they are in the same layer. */
bool is_small_below_shown(const scene *s, const octree_box *box, unsigned depth);

/* Find the node at an address, or its empty cell when the tree no longer has the node. Return false when the scene must
 * not show it: the view's filter hides it, or it is smaller than the view's lod and an ancestor is shown. The second
 * case is counted in tally.small_marked. */
bool find_shown_node(scene *s, const octree *tree, octree_address address, octree_node *node);

/* Add the diagonals of a box's six faces, with ids from 0 to CROSS_LINES - 1. The crosses are recognizable without
 * colour. */
void add_crossed_faces(scene *s, const octree_box *box, scene_style style);
#define CROSS_LINES 12

/* A sieve decides by the id alone which points are dropped when there are more than the budget. So a moving point does
 * not flicker, and its velocity arrow is dropped with it. A sieve whose n lowest bits are set keeps about one id in
 * 2^n. A finer sieve keeps a subset of the same ids. */
static inline bool sieve_drops(uint64_t sieve, uint64_t id)
{
    return octree_digest_word(OCTREE_DIGEST_START, id) & sieve;
}

static inline uint64_t finer_sieve(uint64_t sieve)
{
    return sieve << 1 | 1;
}

#endif
