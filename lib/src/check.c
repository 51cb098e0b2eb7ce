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
    if (n->count <= tree->def.leaf_capacity)
        return "an inner node would fit one leaf";
    if (!may_split(tree, c))
        return "an inner node is deeper than the tree allows";
    return NULL;
}

static const char *check_leaf(const octree *tree, const node *n, cell c)
{
    if (n->count > tree->def.leaf_capacity && may_split(tree, c))
        return "a leaf that could split is over its capacity";
    if (n->count > tree->def.leaf_capacity && tree->def.full_leaf == OCTREE_REFUSE)
        return "a leaf is over its capacity under OCTREE_REFUSE";
    for (uint32_t i = 0; i < n->count; i++) {
        const octree_point *point = &leaf_points(n)[i];
        if (check_position(tree, point->position) != OCTREE_OK)
            return "a point is outside the world";
        const cell own = path_cell(morton_code(tree->axes, point->position), c.depth);
        if (own.low[0] != c.low[0] || own.low[1] != c.low[1] || own.low[2] != c.low[2])
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

/* Nodes and points are summed, so that the order in which they are met does not count. */
static octree_walk_order digest_node(const octree_node *seen, void *context)
{
    uint64_t *sum = context;
    *sum += octree_digest_word(octree_digest_word(OCTREE_DIGEST_START, seen->address), seen->leaf);
    for (size_t i = 0; seen->leaf && i < seen->count; i++) {
        uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, seen->points[i].id);
        for (int j = 0; j < 3; j++)
            digest = octree_digest_double(digest, seen->points[i].position[j]);
        *sum += digest;
    }
    return OCTREE_WALK_ON;
}

uint64_t octree_digest(const octree *tree)
{
    if (!tree)
        return 0;
    uint64_t sum = 0;
    if (octree_walk(tree, digest_node, &sum) != OCTREE_OK)
        return 0;
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, sum);
    digest = octree_digest_word(digest, tree->def.leaf_capacity);
    digest = octree_digest_word(digest, tree->def.max_depth);
    for (int i = 0; i < 3; i++) {
        digest = octree_digest_double(digest, tree->def.world.min[i]);
        digest = octree_digest_double(digest, tree->def.world.max[i]);
    }
    return digest;
}
