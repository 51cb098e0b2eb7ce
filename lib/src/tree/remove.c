/* Algorithm 2: a point is removed; nodes whose points now fit one leaf merge. */
#include "remove.h"

#include <string.h>

/* The depth of the highest node on the path that fits one leaf with one point less; the leaf's own when none does. */
static unsigned merge_depth(const octree *tree, const path *p)
{
    unsigned depth = p->depth;
    while (depth > 0 && fits_leaf(tree, p->nodes[depth - 1]->count - 1))
        depth--;
    return depth;
}

bool reserve_merge(octree *tree, const found_point *found, node *spare)
{
    const unsigned depth = merge_depth(tree, &found->path);
    *spare = (node){.below = NULL};
    return depth == found->path.depth || leaf_create(&tree->store, spare, found->path.nodes[depth]->count - 1);
}

/* Remove an empty leaf from its parent's group of children; the end of the group's block is freed. */
static void drop_child(octree *tree, node *parent, node *child)
{
    node *group = children_of(parent);
    const unsigned children = bits_count8(parent->octants), index = (unsigned)(child - group);
    leaf_release(&tree->store, child);
    memmove(child, child + 1, (children - index - 1) * sizeof(node));
    pool_give(&tree->store.nodes, group + children - 1, 1);
    unsigned octant = 0;
    while (!(parent->octants >> octant & 1) || child_index(parent, octant) != index)
        octant++;
    parent->octants &= (uint8_t) ~(1u << octant);
}

void remove_found(octree *tree, const found_point *found, node *spare)
{
    const path *p = &found->path;
    node *leaf = path_end(p);
    const unsigned depth = merge_depth(tree, p);
    if (depth < p->depth) {
        node_gather(spare, p->nodes[depth], &leaf_points(leaf)[found->index]);
        node_release(&tree->store, p->nodes[depth]);
        *p->nodes[depth] = *spare;
    } else {
        leaf_release(&tree->store, spare);
        leaf_remove(&tree->store, leaf, found->index);
        if (leaf->count == 0 && p->depth > 0)
            drop_child(tree, p->nodes[p->depth - 1], leaf);
    }
    for (unsigned i = 0; i < depth; i++)
        p->nodes[i]->count--;
    tree->version++;
}

octree_status octree_remove(octree *tree, const double position[3], uint64_t id)
{
    const octree_status status = check_position(tree, position);
    if (status != OCTREE_OK)
        return status;
    found_point found;
    if (!find_point(tree, position, id, &found))
        return OCTREE_NOT_FOUND;
    node spare;
    if (!reserve_merge(tree, &found, &spare))
        return OCTREE_NO_MEMORY;
    remove_found(tree, &found, &spare);
    return OCTREE_OK;
}
