/* walk.h - visiting all nodes: with their cells, for their number, for their digest. */
#ifndef OCTREE_WALK_H
#define OCTREE_WALK_H

#include "octree/digest.h"
#include "tree.h"

/* Nodes still to be visited, with their cells. */
typedef struct stacked {
    const node *node;
    octree_address address;
    cell cell;
    octree_box box; /* cell_bounds() of the cell */
} stacked;

typedef struct node_stack {
    const octree *tree;
    size_t size;
    stacked items[STACK_ROOM];
} node_stack;

/* With the root alone. */
static inline void stack_begin(node_stack *stack, const octree *tree)
{
    stack->tree = tree;
    stack->size = 1;
    stack->items[0] = (stacked){&tree->root, OCTREE_ROOT, root_cell(), tree->def.world};
}

static inline const stacked *stack_pop(node_stack *stack)
{
    return &stack->items[--stack->size];
}

/* Push the children of the node that was popped last, so that they are popped in ascending order of octants. */
void stack_push_children(node_stack *stack);

/* Start loading what is below each child of an inner node. */
static inline void prefetch_below(const node *n)
{
    for (unsigned i = bits_count8(n->octants); i-- > 0;)
        prefetch(children_of(n)[i].below);
}

/* Add one node to the statistics. */
void count_node(octree_stats *stats, const node *n, unsigned depth);

/* The digest of a tree is made of the sum of what each node adds, so that the order in which nodes and points are
 * visited does not count, and the sum of an unchanged subtree can be kept. A leaf adds its points too. */
uint64_t digest_node(const node *n, octree_address address);
uint64_t digest_of_sum(const octree *tree, uint64_t sum);

#endif
