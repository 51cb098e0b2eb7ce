/* SPDX-License-Identifier: MIT */
/* diagram_slots.h - the diagram's layout: which nodes are drawn one by one, and where across the picture each stands.
 *
 * A node has a slot, an interval within 0 to 1, which is divided among its octants in Morton order. The share of a leaf
 * is 1; that of an inner node is the number of shares below it, rounded up to 2, 3, 4, 6, 8, 12, 16, 24 ...: a split or
 * merge moves the node's siblings, but those of its ancestors only when one of these steps is crossed. If the whole
 * tree fits so, an empty octant has a share of 1 too, so that filling it moves nothing; else 0.
 *
 * Nodes are drawn one by one down to the deepest level at which every share is wide enough. Deeper nodes are folded:
 * each is placed in the slot of its ancestor at that level, at its points' position among the ancestor's points in
 * Morton order.
 */
#ifndef COMPOSE_DIAGRAM_SLOTS_H
#define COMPOSE_DIAGRAM_SLOTS_H

#include "octree/types.h"

typedef struct diagram_node {
    octree_address address;
    octree_box box;
    size_t points; /* in and below it */
    uint8_t depth, octants;
    bool leaf;
    uint64_t child_shares; /* the shares of its octants */
    double left, right;    /* of its slot */
} diagram_node;

typedef struct diagram_slots {
    diagram_node *nodes; /* down to `deepest`, in pre-order */
    size_t count;
    unsigned deepest;
    unsigned empty;     /* the share of an empty octant: 1 or 0 */
    octree_stats stats; /* of the whole tree */
} diagram_slots;

/* Arrange a tree in at most `room` shares, at least 1. False when there is no memory. Cost: O(nodes).
 */
bool diagram_arrange(diagram_slots *slots, const octree *tree, size_t room);
void diagram_slots_release(diagram_slots *slots);

/* Visit the folded nodes in pre-order, with the position of each, 0 to 1. Cost: O(nodes). */
typedef void (*diagram_visitor)(const octree_node *node, double middle, void *context);
void diagram_visit_folded(const diagram_slots *slots, const octree *tree, diagram_visitor visit, void *context);

#endif
