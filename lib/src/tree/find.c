/* find.c - Algorithm 3: is there a point at these coordinates? */
#include "leaf.h"
#include "remove.h"

octree_status octree_find(const octree *tree, const double position[3], uint64_t *id)
{
    const octree_status status = check_position(tree, position);
    if (status != OCTREE_OK)
        return status;
    const path way = path_to(tree, morton_code(tree->axes, position));
    const node *leaf = path_end(&way);
    bool found = false;
    uint64_t lowest = UINT64_MAX;
    for (uint32_t i = 0; leaf->octants == 0 && i < leaf->count; i++) {
        const octree_point *point = &leaf_points(leaf)[i];
        if (same_position(point->position, position)) {
            found = true;
            lowest = point->id < lowest ? point->id : lowest;
        }
    }
    if (found && id)
        *id = lowest;
    return found ? OCTREE_OK : OCTREE_NOT_FOUND;
}

bool octree_contains(const octree *tree, const double position[3], uint64_t id)
{
    found_point found;
    return check_position(tree, position) == OCTREE_OK && find_point(tree, position, id, &found);
}
