/* diagram_slots.h - the diagram's layout: which nodes are drawn one by one, and where across the picture each stands.
 *
 * A node has a slot, an interval from 0 to 1, and deals it out to its octants in Morton order. The share of a leaf is
 * 1; that of an inner node is the number of shares below it, rounded up to 2, 3, 4, 6, 8, 12, 16, 24 ...: what splits
 * or merges moves what is beside it, and what is beside its ancestors only where one of these steps is passed. Where
 * the whole tree has room for it, an empty octant has a share of 1 too, so that filling it moves nothing; else it has
 * none.
 *
 * Nodes are drawn one by one down to the deepest level at which every share is wide enough. What is deeper is folded:
 * it stands within the slot of its ancestor at that level, where its points are among the ancestor's in Morton order.
 */
#ifndef LAYERS_DIAGRAM_SLOTS_H
#define LAYERS_DIAGRAM_SLOTS_H

#include "octree/octree.h"

typedef struct diagram_node {
    octree_address address;
    octree_box box;
    size_t points; /* in and below it */
    uint8_t depth, octants;
    bool leaf;
    uint64_t below;     /* the shares of its octants */
    double left, right; /* of its slot */
} diagram_node;

typedef struct diagram_slots {
    diagram_node *nodes; /* down to `deepest`, in pre-order */
    size_t count;
    unsigned deepest;
    unsigned empty;     /* the share of an empty octant: 1 or 0 */
    octree_stats stats; /* of the whole tree */
} diagram_slots;

/* Arrange a tree in at most `room` shares, of which there must be one. False when there is no memory. Cost: O(nodes).
 */
bool diagram_arrange(diagram_slots *slots, const octree *tree, size_t room);
void diagram_slots_release(diagram_slots *slots);

/* Visit the nodes that are folded, in pre-order, with the place where each stands. Cost: O(nodes). */
typedef void (*diagram_visitor)(const octree_node *node, double middle, void *context);
void diagram_visit_folded(const diagram_slots *slots, const octree *tree, diagram_visitor visit, void *context);

#endif
