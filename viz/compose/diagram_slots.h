/* SPDX-License-Identifier: MIT */
/* diagram_slots.h - the layout of the diagram: which nodes are drawn one by one, and the horizontal position of each.
 *
 * The problem: a tree is drawn in a picture of fixed width, tick after tick. If all leaves had the same width, every
 * split would move the whole diagram. If every octant had an eighth of its parent's width, deep nodes would have no
 * width.
 *
 * The idea: each node has a slot, an interval within 0 to 1. A node divides its slot among its octants in Morton order,
 * in proportion to the octants' shares. The share of a leaf is 1. The share of an inner node is the sum of its octants'
 * shares, rounded up to 1, 2, 3, 4, 6, 8, 12, 16, 24 ... A split or merge moves the siblings of the node. It moves the
 * siblings of an ancestor only if the ancestor's rounded sum changes. An empty octant also has the share 1 if the whole
 * tree then still fits, so that nothing moves when a point enters the octant. Otherwise the share of an empty octant is
 * 0.
 *
 * Nodes are drawn one by one down to the deepest level at which every share is wide enough. Deeper nodes are folded.
 * The position of a folded node lies within the slot of its ancestor at that level. Within that slot, it corresponds to
 * the place of the node's points among the ancestor's points in Morton order. */
#ifndef COMPOSE_DIAGRAM_SLOTS_H
#define COMPOSE_DIAGRAM_SLOTS_H

#include "octree/types.h"

typedef struct diagram_node {
    octree_address address;
    octree_box box;
    size_t points; /* number of points in the node and its descendants */
    uint8_t depth, octants;
    bool leaf;
    uint64_t child_shares; /* sum of the shares of the node's octants, before rounding up */
    double left, right;    /* the ends of the node's slot, as fractions of the diagram's width */
} diagram_node;

typedef struct diagram_slots {
    diagram_node *nodes; /* the nodes down to the level `deepest`, in pre-order */
    size_t count;
    unsigned deepest;
    unsigned empty;     /* the share of an empty octant, 1 or 0 */
    octree_stats stats; /* statistics of the whole tree */
} diagram_slots;

/* Arrange a tree so that the sum of the shares of the root's octants is at most `room`, which must be at least 1.
 * Return false if memory runs out. Cost: O(nodes). */
bool diagram_arrange(diagram_slots *slots, const octree *tree, size_t room);
void diagram_slots_release(diagram_slots *slots);

/* Call `visit` for each folded node, in pre-order. `middle` is the horizontal position of a node, from 0 (left) to 1.
 * Cost: O(nodes). */
typedef void (*diagram_visitor)(const octree_node *node, double middle, void *context);
void diagram_visit_folded(const diagram_slots *slots, const octree *tree, diagram_visitor visit, void *context);

#endif
