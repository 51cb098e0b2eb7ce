/* check.c - the validator: every invariant of the nodes. */
#include "exact.h"
#include "float_rules.h"
#include "tree.h"

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

/* Where the points of a leaf may lie. A cell is open at its upper planes, except at the world's maximum faces, which
 * belong to it. */
static octree_box points_box(const octree *tree, cell c)
{
    octree_box box = cell_bounds(tree->axes, c);
    for (int i = 0; i < 3; i++)
        if (c.low[i] + cell_size(c.depth) != PLANE_GRID)
            box.max[i] = exact_step_down(box.max[i]);
    return box;
}

static const char *check_leaf(const octree *tree, const node *n, cell c)
{
    const octree_box box = points_box(tree, c);
    if (!fits_leaf(tree, n->count) && may_split(tree, c))
        return "a leaf that could split is over its capacity";
    if (!fits_leaf(tree, n->count) && tree->def.full_leaf == OCTREE_REFUSE)
        return "a leaf is over its capacity under OCTREE_REFUSE";
    for (uint32_t i = 0; i < n->count; i++) {
        const octree_point *point = &leaf_points(n)[i];
        const double *position = point->position;
        if (!box_contains(&box, position))
            return box_contains(&tree->def.world, position) ? "a point is not in its leaf's cell"
                                                            : "a point is outside the world";
        if (leaf_find(n, position, point->id) != i)
            return "a pair of position and id is stored twice";
    }
    return NULL;
}

/* Check a node and what is below it; *where receives the first node that breaks an invariant. */
static const char *check_below(const octree *tree, const node *n, octree_address address, cell c, octree_address *where)
{
    const char *broken = n->octants ? check_inner(tree, n, c) : check_leaf(tree, n, c);
    const node *child = children_of(n);
    if (broken && where)
        *where = address;
    for (unsigned octant = 0; !broken && octant < 8; octant++)
        if (n->octants >> octant & 1)
            broken = check_below(tree, child++, address << 3 | octant, cell_child(c, octant), where);
    return broken;
}

const char *octree_check(const octree *tree, octree_address *where)
{
    if (!tree)
        return "there is no tree";
    if (!float_mode_is_default())
        return octree_status_text(OCTREE_FLOAT_MODE);
    return check_below(tree, &tree->root, OCTREE_ROOT, root_cell(), where);
}
