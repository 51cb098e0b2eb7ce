/* move.c - a point goes from one place to another, or stays. */
#include "insert.h"
#include "leaf.h"
#include "remove.h"

/* Both places lie in one leaf: nothing can refuse it. */
static octree_status move_within(octree *tree, const found_point *found, const octree_point *moved)
{
    node *leaf = path_end(&found->way);
    leaf_replace(leaf, found->index, moved);
    tree->version++;
    return OCTREE_OK;
}

/* Insert first: that alone can be refused. The memory for the removal is taken before, as much as it can need: between
 * the two the tree only grows, so that what would not merge now will not merge then. */
static octree_status move_across(octree *tree, const found_point *found, const octree_point *moved)
{
    const octree_point old = leaf_points(path_end(&found->way))[found->index];
    node room;
    if (!reserve_merge(tree, found, &room))
        return OCTREE_NO_MEMORY;
    const octree_status status = insert_point(tree, moved);
    if (status != OCTREE_OK) {
        leaf_release(tree, &room);
        return status;
    }
    found_point again; /* the insertion may have moved groups of nodes */
    find_point(tree, old.position, old.id, &again);
    remove_found(tree, &again, &room);
    return OCTREE_OK;
}

octree_status octree_move(octree *tree, const double from[3], uint64_t id, const double to[3])
{
    octree_status status = check_position(tree, from);
    if (status == OCTREE_OK)
        status = check_position(tree, to);
    if (status != OCTREE_OK)
        return status;
    found_point found;
    if (!find_point(tree, from, id, &found))
        return OCTREE_NOT_FOUND;
    const octree_point moved = {{to[0], to[1], to[2]}, id};
    const path way = path_to(tree, morton_code(tree->axes, to));
    if (path_end(&way) != path_end(&found.way))
        return move_across(tree, &found, &moved);
    const uint32_t taken = leaf_find(path_end(&way), to, id);
    return taken == LEAF_NONE || taken == found.index ? move_within(tree, &found, &moved) : OCTREE_DUPLICATE;
}
