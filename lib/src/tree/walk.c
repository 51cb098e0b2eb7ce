/* walk.c - looking at the nodes: one by one, by address, by position, and in numbers. */
#include "float_mode.h"
#include "leaf.h"
#include "node_count.h"

static octree_node describe(const node *n, octree_address address, unsigned depth, const octree_box *bounds)
{
    return (octree_node){
        .address = address,
        .depth = depth,
        .leaf = n->octants == 0,
        .octants = n->octants,
        .box = *bounds,
        .count = n->count,
        .points = n->octants ? NULL : leaf_points(n),
    };
}

octree_status octree_walk(const octree *tree, octree_node_visitor visit, void *context)
{
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    node_stack stack;
    stack_begin(&stack, tree);
    while (stack.size > 0) {
        const stacked *next = stack_pop(&stack);
        const octree_node seen = describe(next->node, next->address, next->cell.depth, &next->box);
        const octree_walk_order order = visit(&seen, context);
        if (order == OCTREE_WALK_STOP)
            break;
        if (order == OCTREE_WALK_ON && next->node->octants)
            stack_push_children(&stack);
    }
    return OCTREE_OK;
}

octree_status octree_node_at(const octree *tree, octree_address address, octree_node *result)
{
    if (!tree || !result)
        return OCTREE_NULL_ARGUMENT;
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    if (!is_address(address))
        return OCTREE_NOT_FOUND;
    const node *n = &tree->root;
    cell c = root_cell();
    while (c.depth < octree_address_depth(address)) {
        const unsigned octant = octree_address_octant(address, c.depth);
        n = child_at(n, octant);
        if (!n)
            return OCTREE_NOT_FOUND;
        c = cell_child(c, octant);
    }
    const octree_box bounds = cell_bounds(tree->axes, c);
    *result = describe(n, address, c.depth, &bounds);
    return OCTREE_OK;
}

octree_status octree_locate(const octree *tree, const double position[3], octree_node *result)
{
    const octree_status status = result ? check_position(tree, position) : OCTREE_NULL_ARGUMENT;
    if (status != OCTREE_OK)
        return status;
    const uint64_t code = morton_code(tree->axes, position);
    const path way = path_to(tree, code);
    const octree_box bounds = cell_bounds(tree->axes, path_cell(code, way.depth));
    *result = describe(path_end(&way), morton_address(code, way.depth), way.depth, &bounds);
    return OCTREE_OK;
}

octree_status octree_statistics(const octree *tree, octree_stats *stats)
{
    if (!tree || !stats)
        return OCTREE_NULL_ARGUMENT;
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    *stats = (octree_stats){.points = tree->root.count, .memory = tree->memory.bytes};
    count_node(stats, &tree->root, 0);
    inner_stack stack;
    inner_stack_begin(&stack, &tree->root, OCTREE_ROOT);
    while (stack.size > 0) {
        const inner next = inner_stack_next(&stack);
        const unsigned depth = octree_address_depth(next.address) + 1, children = bits_count8(next.node->octants);
        for (unsigned i = 0; i < children; i++)
            count_node(stats, &children_of(next.node)[i], depth);
    }
    return OCTREE_OK;
}
