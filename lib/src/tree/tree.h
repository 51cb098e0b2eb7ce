/* tree.h - the tree's insides: nodes, and the way from the root to a leaf. Private to the library.
 *
 * Shape rule (canonical form): a node is an inner node exactly when it holds more points than the capacity and its
 * cell can be divided further. So the nodes follow from the contents, whatever the order of changes.
 */
#ifndef OCTREE_TREE_H
#define OCTREE_TREE_H

#include "plane.h"
#include "point.h"
#include "pool.h"

typedef struct node {
    void *below; /* inner: its children, struct node[], occupied octants only; leaf: its octree_point[]; may be null */
    uint32_t count;  /* points in and below */
    uint8_t octants; /* the occupied ones; 0 for a leaf */
    uint8_t room;    /* leaf: points that its block has room for; LEAF_CROWD when it is a crowd (leaf.h) */
} node;

/* Whether the capacity is chosen by itself (tune.h). */
typedef struct tuning {
    bool automatic;
    octree_mix mix;
    size_t due; /* the number of points at which it is chosen next */
} tuning;

struct octree {
    octree_def def; /* as in force */
    axis axes[3];
    double scale; /* the power of two that brings the world's extent near 1 (metric.h) */
    uint64_t version;
    tuning tuning;
    node root;
    arena memory;
    pool nodes;
    pool points;
};

static inline node *children_of(const node *n)
{
    return n->below;
}

/* Whether all coordinates are subnormal, and their differences. */
static inline bool is_subnormal_world(const octree *tree)
{
    return tree->axes[0].subnormal && tree->axes[1].subnormal && tree->axes[2].subnormal;
}

/* Ask for memory that will be read soon. Only speed depends on it. */
static inline void prefetch(const void *memory)
{
#if defined(__GNUC__)
    __builtin_prefetch(memory);
#else
    (void)memory;
#endif
}

/* What is below each child of an inner node. */
static inline void prefetch_below(const node *n)
{
    for (unsigned i = bits_count8(n->octants); i-- > 0;)
        prefetch(((const node *)n->below)[i].below);
}

static inline unsigned child_index(const node *n, unsigned octant)
{
    return bits_count8(n->octants & ((1u << octant) - 1));
}

/* The child in an octant, or null when the octant is not occupied. */
static inline node *child_at(const node *n, unsigned octant)
{
    return n->octants >> octant & 1 ? children_of(n) + child_index(n, octant) : NULL;
}

static inline cell root_cell(void)
{
    return (cell){{0, 0, 0}, 0};
}

/* True when a full leaf in this cell splits rather than refuses or grows. */
static inline bool may_split(const octree *tree, cell c)
{
    return c.depth < tree->def.max_depth && cell_divisible(tree->axes, c);
}

/* How many points one leaf may hold. Nodes that hold no more merge, and those that hold more split where they may. */
static inline bool fits_leaf(const octree *tree, size_t count)
{
    return count <= tree->def.leaf_capacity;
}

/* The nodes from the root towards a code: as deep as they exist. The last one is a leaf, or an inner node whose octant
 * for this code is not occupied. */
typedef struct path {
    node *nodes[OCTREE_MAX_DEPTH + 1];
    unsigned depth; /* of the last node */
} path;

path path_to(const octree *tree, uint64_t code);

static inline node *path_end(const path *way)
{
    return way->nodes[way->depth];
}

/* The cell of the given depth on the way to a code. */
cell path_cell(uint64_t code, unsigned depth);

/* OK, NULL_ARGUMENT, NOT_FINITE or OUTSIDE. */
octree_status check_position(const octree *tree, const double position[3]);

/* Nodes still to be visited, with their cells: a stack that no input can make deeper than D levels of 8 children. */
#define STACK_ROOM (7 * OCTREE_MAX_DEPTH + 8)

typedef struct stacked {
    const node *node;
    octree_address address;
    cell cell;
    octree_box box; /* cell_bounds() of the cell: all but the middle planes is known from the parent's */
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

/* Inner nodes still to be visited, with their addresses: for those who look at all children of a node at once, and ask
 * for no cells. */
typedef struct inner {
    const node *node;
    octree_address address;
} inner;

typedef struct inner_stack {
    size_t size;
    inner items[STACK_ROOM];
} inner_stack;

/* With a node alone, or, where that is a leaf, with nothing. */
static inline void inner_stack_begin(inner_stack *stack, const node *n, octree_address address)
{
    stack->size = n->octants != 0;
    stack->items[0] = (inner){n, address};
}

/* Pop a node, and push those of its children that are inner nodes, to be popped in ascending order of octants. */
inner inner_stack_next(inner_stack *stack);

/* Free a node's children or points, and all below; the node itself is the caller's. */
void node_release(octree *tree, node *n);

#endif
