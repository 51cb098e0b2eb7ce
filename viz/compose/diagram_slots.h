/* SPDX-License-Identifier: MIT */
/* diagram_slots.h - the diagram's layout: which nodes are drawn one by one, and where across the picture each stands.
 * The problem: a tree is drawn as a tree, in a picture of fixed width, tick after tick. If the leaves simply shared the
 * width, every split would move the whole diagram. If every octant had its fixed eighth, deep nodes would have no
 * width.
 *
 * The idea: each node has a slot, an interval within 0 to 1, and divides it among its octants in Morton order, in
 * proportion to their shares. The share of a leaf is 1. The share of an inner node is the sum of its octants' shares,
 * rounded up to 1, 2, 3, 4, 6, 8, 12, 16, 24 ... A split or merge moves the node's siblings, but the siblings of an
 * ancestor only when the ancestor's sum crosses one of these steps. If the whole tree fits that way, an empty octant
 * has a share of 1 too, so that filling it moves nothing; otherwise its share is 0.
 *
 * Nodes are drawn one by one down to the deepest level at which every share is wide enough. Deeper nodes are folded: a
 * node is placed within the slot of its ancestor at that level, where its points lie among the ancestor's points in
 * Morton order. */
#ifndef COMPOSE_DIAGRAM_SLOTS_H
#define COMPOSE_DIAGRAM_SLOTS_H

#include "octree/types.h"

typedef struct diagram_node {
    octree_address address;
    octree_box box;
    size_t points; /* in the node and its descendants */
    uint8_t depth, octants;
    bool leaf;
    uint64_t child_shares; /* the sum of its octants' shares, before rounding up */
    double left, right;    /* the ends of its slot, 0 to 1 */
} diagram_node;

typedef struct diagram_slots {
    diagram_node *nodes; /* the nodes down to the level `deepest`, in pre-order */
    size_t count;
    unsigned deepest;
    unsigned empty;     /* the share of an empty octant: 1 or 0 */
    octree_stats stats; /* of the whole tree */
} diagram_slots;

/* Arrange a tree in at most `room` shares; room is at least 1. Return false when there is no memory. Cost: O(nodes). */
bool diagram_arrange(diagram_slots *slots, const octree *tree, size_t room);
void diagram_slots_release(diagram_slots *slots);

/* Visit the folded nodes in pre-order. `middle` is a node's position, 0 to 1. Cost: O(nodes). */
typedef void (*diagram_visitor)(const octree_node *node, double middle, void *context);
void diagram_visit_folded(const diagram_slots *slots, const octree *tree, diagram_visitor visit, void *context);

#endif
