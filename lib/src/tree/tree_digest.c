/* tree_digest.c - see tree_digest.h. */
#include "tree_digest.h"
#include "float_mode.h"
#include "leaf.h"

uint64_t digest_node(const node *n, octree_address address)
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

static uint64_t digest_nodes(const octree *tree)
{
    uint64_t sum = digest_node(&tree->root, OCTREE_ROOT);
    inner_stack stack;
    inner_stack_begin(&stack, &tree->root, OCTREE_ROOT);
    while (stack.size > 0) {
        const inner next = inner_stack_next(&stack);
        const node *child = children_of(next.node);
        prefetch_below(next.node);
        for (unsigned octant = 0; octant < 8; octant++)
            if (next.node->octants >> octant & 1)
                sum += digest_node(child++, next.address << 3 | octant);
    }
    return sum;
}

uint64_t digest_of_sum(const octree *tree, uint64_t sum)
{
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, sum);
    digest = octree_digest_word(digest, tree->def.leaf_capacity);
    digest = octree_digest_word(digest, tree->def.max_depth);
    for (int i = 0; i < 3; i++) {
        digest = octree_digest_double(digest, tree->def.world.min[i]);
        digest = octree_digest_double(digest, tree->def.world.max[i]);
    }
    return digest;
}

uint64_t octree_digest(const octree *tree)
{
    return tree && float_mode_is_default() ? digest_of_sum(tree, digest_nodes(tree)) : 0;
}
