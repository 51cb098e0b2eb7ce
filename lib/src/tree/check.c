/* check.c - the validator: every invariant of the nodes. */
#include "exact.h"
#include "float_rules.h"
#include "walk.h"

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
static octree_box points_box(const stacked *leaf)
{
    octree_box box = leaf->box;
    for (int i = 0; i < 3; i++)
        if (leaf->cell.low[i] + cell_size(leaf->cell.depth) != PLANE_GRID)
            box.max[i] = exact_step_down(box.max[i]);
    return box;
}

/* Whether a leaf's point is stored at a lower index too. */
static bool is_repeated(const node *n, uint32_t index)
{
    const octree_point *points = leaf_points(n), *point = &points[index];
    if (n->room == LEAF_HASHED)
        return leaf_find(n, point->position, point->id) != index;
    for (uint32_t i = 0; i < index; i++)
        if (points[i].id == point->id && same_position(points[i].position, point->position))
            return true;
    return false;
}

static const char *check_leaf(const octree *tree, const stacked *leaf)
{
    const node *n = leaf->node;
    const octree_box box = points_box(leaf);
    if (!fits_leaf(tree, n->count) && may_split(tree, leaf->cell))
        return "a leaf that could split is over its capacity";
    if (!fits_leaf(tree, n->count) && tree->def.full_leaf == OCTREE_REFUSE)
        return "a leaf is over its capacity under OCTREE_REFUSE";
    for (uint32_t i = 0; i < n->count; i++) {
        const double *position = leaf_points(n)[i].position;
        if (!box_contains(&box, position))
            return box_contains(&tree->def.world, position) ? "a point is not in its leaf's cell"
                                                            : "a point is outside the world";
        if (is_repeated(n, i))
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
    node_stack stack;
    stack_begin(&stack, tree);
    while (stack.size > 0) {
        const stacked *next = stack_pop(&stack);
        const char *broken = next->node->octants ? check_inner(tree, next->node, next->cell) : check_leaf(tree, next);
        if (broken && where)
            *where = next->address;
        if (broken)
            return broken;
        if (next->node->octants)
            stack_push_children(&stack);
    }
    return NULL;
}
