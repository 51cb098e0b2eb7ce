/* check.c - the validator: every invariant of the nodes, and a digest of them. */
#include "float_mode.h"
#include "leaf.h"
#include "octree/digest.h"

static const char *check_inner(const octree *tree, const node *n, cell c)
{
    uint64_t below = 0;
    const unsigned children = bits_count8(n->octants);
    for (unsigned i = 0; i < children; i++) {
        if (children_of(n)[i].count == 0)
            return "a node other than the root is empty";
        below += children_of(n)[i].count;
    }
    if (below != n->count)
        return "a node's count is not the sum of its children's";
    if (fits_leaf(tree, n->count))
        return "an inner node would fit one leaf";
    if (!may_split(tree, c))
        return "an inner node is deeper than the tree allows";
    return NULL;
}

static bool is_inside(const octree *tree, const double position[3])
{
    bool inside = true; /* NaN is not */
    for (int i = 0; i < 3; i++)
        inside &= tree->axes[i].min <= position[i] && position[i] <= tree->axes[i].max;
    return inside;
}

static const char *check_leaf(const octree *tree, const node *n, cell c)
{
    const octree_address own = cell_address(c);
    if (n->count > tree->def.leaf_capacity && may_split(tree, c))
        return "a leaf that could split is over its capacity";
    if (n->count > tree->def.leaf_capacity && tree->def.full_leaf == OCTREE_REFUSE)
        return "a leaf is over its capacity under OCTREE_REFUSE";
    for (uint32_t i = 0; i < n->count; i++) {
        const octree_point *point = &leaf_points(n)[i];
        if (!is_inside(tree, point->position))
            return "a point is outside the world";
        if (morton_address(morton_code(tree->axes, point->position), c.depth) != own)
            return "a point is not in its leaf's cell";
        if (leaf_find(n, point->position, point->id) != i)
            return "a pair of position and id is stored twice";
    }
    return NULL;
}

const char *octree_check(const octree *tree, octree_address *where)
{
    if (!tree)
        return "there is no tree";
    if (!float_mode_is_default())
        return octree_status_text(OCTREE_FLOAT_MODE);
    node_stack stack = {.size = 0};
    stack_push(&stack, &tree->root, root_cell());
    while (stack.size > 0) {
        const stacked next = stack_pop(&stack);
        const char *broken =
            next.node->octants ? check_inner(tree, next.node, next.cell) : check_leaf(tree, next.node, next.cell);
        if (broken && where)
            *where = cell_address(next.cell);
        if (broken)
            return broken;
        if (next.node->octants)
            stack_push_children(&stack, next);
    }
    return NULL;
}

static uint64_t digest_node(const node *n, octree_address address)
{
    uint64_t sum = octree_digest_word(octree_digest_word(OCTREE_DIGEST_START, address), n->octants == 0);
    for (size_t i = 0; n->octants == 0 && i < n->count; i++) {
        const octree_point *point = &leaf_points(n)[i];
        uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, point->id);
        for (int j = 0; j < 3; j++)
            digest = octree_digest_double(digest, point->position[j]);
        sum += digest;
    }
    return sum;
}

/* Nodes and points are summed, so that the order in which they are met does not count. */
uint64_t octree_digest(const octree *tree)
{
    if (!tree || !float_mode_is_default())
        return 0;
    uint64_t sum = 0;
    node_stack stack = {.size = 0};
    stack_push(&stack, &tree->root, root_cell());
    while (stack.size > 0) {
        const stacked next = stack_pop(&stack);
        sum += digest_node(next.node, cell_address(next.cell));
        if (next.node->octants)
            stack_push_children(&stack, next);
    }
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, sum);
    digest = octree_digest_word(digest, tree->def.leaf_capacity);
    digest = octree_digest_word(digest, tree->def.max_depth);
    for (int i = 0; i < 3; i++) {
        digest = octree_digest_double(digest, tree->def.world.min[i]);
        digest = octree_digest_double(digest, tree->def.world.max[i]);
    }
    return digest;
}
