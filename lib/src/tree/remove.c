/* remove.c - Algorithm 2: a point is taken out; nodes whose points now fit one leaf merge. */
#include "remove.h"
#include "leaf.h"

#include <string.h>

bool find_point(const octree *tree, const double position[3], uint64_t id, found_point *found)
{
    found->way = path_to(tree, morton_code(tree->axes, position));
    const node *end = path_end(&found->way);
    if (end->octants)
        return false;
    found->index = leaf_find(end, position, id);
    return found->index != LEAF_NONE;
}

/* The depth of the highest node on the way that fits one leaf when a point is gone; the leaf's own when none does. */
static unsigned merge_depth(const octree *tree, const path *way)
{
    unsigned depth = way->depth;
    while (depth > 0 && fits_leaf(tree, way->nodes[depth - 1]->count - 1))
        depth--;
    return depth;
}

bool reserve_merge(octree *tree, const found_point *found, node *room)
{
    const unsigned depth = merge_depth(tree, &found->way);
    *room = (node){.below = NULL};
    return depth == found->way.depth || leaf_create(tree, room, found->way.nodes[depth]->count - 1);
}

static void merge(octree *tree, node *n, const octree_point *left_out, node *room)
{
    leaf_gather(room, n, left_out);
    node_release(tree, n);
    *n = *room;
}

/* Take an empty leaf out of its parent's group of children; the group's block loses its tail. */
static void drop_child(octree *tree, node *parent, node *child)
{
    node *group = children_of(parent);
    const unsigned children = bits_count8(parent->octants), index = (unsigned)(child - group);
    leaf_release(tree, child);
    memmove(child, child + 1, (children - index - 1) * sizeof(node));
    pool_give(&tree->nodes, group + children - 1, 1);
    unsigned octant = 0;
    while (!(parent->octants >> octant & 1) || child_index(parent, octant) != index)
        octant++;
    parent->octants &= (uint8_t) ~(1u << octant);
}

void remove_found(octree *tree, const found_point *found, node *room)
{
    const path *way = &found->way;
    node *leaf = path_end(way);
    const unsigned depth = merge_depth(tree, way);
    if (depth < way->depth) {
        merge(tree, way->nodes[depth], &leaf_points(leaf)[found->index], room);
    } else {
        leaf_release(tree, room);
        leaf_take(tree, leaf, found->index);
        if (leaf->count == 0 && way->depth > 0)
            drop_child(tree, way->nodes[way->depth - 1], leaf);
    }
    for (unsigned i = 0; i < depth; i++)
        way->nodes[i]->count--;
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
    node room;
    if (!reserve_merge(tree, &found, &room))
        return OCTREE_NO_MEMORY;
    remove_found(tree, &found, &room);
    return OCTREE_OK;
}
