/* insert.c - Algorithm 1: a point goes down to its leaf; a full leaf splits, refuses or grows. */
#include "insert.h"
#include "leaf.h"

#include <string.h>

/* The path's last node is inner, and the octant is not occupied: give it a leaf with this point. */
static octree_status add_child(octree *tree, node *parent, unsigned octant, const octree_point *point)
{
    const unsigned children = bits_count8(parent->octants), index = child_index(parent, octant);
    node leaf = {0};
    if (!leaf_append(tree, &leaf, point))
        return OCTREE_NO_MEMORY;
    node *group = pool_take(&tree->nodes, children + 1);
    if (!group) {
        leaf_release(tree, &leaf);
        return OCTREE_NO_MEMORY;
    }
    memcpy(group, parent->below, index * sizeof(node));
    group[index] = leaf;
    memcpy(group + index + 1, children_of(parent) + index, (children - index) * sizeof(node));
    pool_give(&tree->nodes, parent->below, children);
    parent->below = group;
    parent->octants |= (uint8_t)(1u << octant);
    return OCTREE_OK;
}

/* The depth at which a full leaf of depth `*depth` and a new point come apart, or the depth of the cell that holds them
 * all and cannot be divided. True in the first case. */
static bool parting_depth(const octree *tree, const node *leaf, uint64_t code, unsigned *depth)
{
    if (!may_split(tree, path_cell(code, *depth)))
        return false;    /* before its points are read: a crowd has many */
    uint64_t unlike = 0; /* the bits in which any point's code differs from the new one's */
    for (uint32_t i = 0; i < leaf->count; i++)
        unlike |= morton_code(tree->axes, leaf_points(leaf)[i].position) ^ code;
    for (cell c = path_cell(code, *depth);; c = cell_child(c, morton_octant(code, c.depth))) {
        *depth = c.depth;
        if (!may_split(tree, c))
            return false;
        if (morton_octant(unlike, c.depth) != 0)
            return true;
    }
}

/* How many points of a full leaf, and of a new one, each octant of a node of this depth receives. */
typedef struct shares {
    uint32_t counts[8];
    uint8_t mask;
} shares;

static shares count_shares(const octree *tree, const node *full, uint64_t code, unsigned depth)
{
    shares s = {.mask = (uint8_t)(1u << morton_octant(code, depth))};
    s.counts[morton_octant(code, depth)] = 1;
    for (uint32_t i = 0; i < full->count; i++) {
        const unsigned octant = morton_octant(morton_code(tree->axes, leaf_points(full)[i].position), depth);
        s.counts[octant]++;
        s.mask |= (uint8_t)(1u << octant);
    }
    return s;
}

static bool make_leaves(octree *tree, node *group, const shares *s)
{
    for (unsigned octant = 0; octant < 8; octant++)
        if (s->counts[octant] && !leaf_create(tree, group++, s->counts[octant]))
            return false;
    return true;
}

/* An inner node whose leaves share the points of a full leaf and a new one. No memory: nothing is left behind. */
static bool make_parting(octree *tree, node *made, const node *full, const octree_point *point, uint64_t code,
                         unsigned depth)
{
    const shares s = count_shares(tree, full, code, depth);
    const unsigned children = bits_count8(s.mask);
    node *group = pool_take(&tree->nodes, children);
    if (!group)
        return false;
    memset(group, 0, children * sizeof(node));
    *made = (node){.below = group, .count = full->count + 1, .octants = s.mask};
    if (!make_leaves(tree, group, &s)) {
        node_release(tree, made);
        return false;
    }
    for (uint32_t i = 0; i < full->count; i++) {
        const octree_point *next = &leaf_points(full)[i];
        const unsigned octant = morton_octant(morton_code(tree->axes, next->position), depth);
        leaf_append(tree, child_at(made, octant), next); /* there is room */
    }
    return leaf_append(tree, child_at(made, morton_octant(code, depth)), point);
}

/* A leaf of the points of a full leaf and a new one. */
static bool make_grown(octree *tree, node *made, const node *full, const octree_point *point)
{
    if (!leaf_create(tree, made, full->count + 1))
        return false;
    for (uint32_t i = 0; i < full->count; i++)
        leaf_append(tree, made, &leaf_points(full)[i]); /* there is room */
    return leaf_append(tree, made, point);
}

/* Put `bottom`, a node of depth `from`, under a chain of only children up to depth `to`. */
static bool make_chain(octree *tree, node *bottom, uint64_t code, unsigned from, unsigned to)
{
    for (; from > to; from--) {
        node *only = pool_take(&tree->nodes, 1);
        if (!only) {
            node_release(tree, bottom);
            return false;
        }
        *only = *bottom;
        *bottom =
            (node){.below = only, .count = only->count, .octants = (uint8_t)(1u << morton_octant(code, from - 1))};
    }
    return true;
}

/* A full leaf of depth `depth` meets one more point. What replaces it is made beside it and then put in its place, so
 * that nothing has happened when memory runs out. */
static octree_status overflow(octree *tree, node *leaf, const octree_point *point, uint64_t code, unsigned depth)
{
    unsigned bottom = depth;
    const bool parts = parting_depth(tree, leaf, code, &bottom);
    if (!parts && tree->def.full_leaf == OCTREE_REFUSE)
        return OCTREE_FULL;
    if (!parts && bottom == depth)
        return leaf_append(tree, leaf, point) ? OCTREE_OK : OCTREE_NO_MEMORY;
    node made;
    const bool enough =
        parts ? make_parting(tree, &made, leaf, point, code, bottom) : make_grown(tree, &made, leaf, point);
    if (!enough || !make_chain(tree, &made, code, bottom, depth))
        return OCTREE_NO_MEMORY;
    leaf_release(tree, leaf);
    *leaf = made;
    return OCTREE_OK;
}

static octree_status add_to_leaf(octree *tree, node *leaf, const octree_point *point, uint64_t code, unsigned depth)
{
    if (leaf_find(leaf, point->position, point->id) != LEAF_NONE)
        return OCTREE_DUPLICATE;
    if (leaf->count >= tree->def.leaf_capacity)
        return overflow(tree, leaf, point, code, depth);
    return leaf_append(tree, leaf, point) ? OCTREE_OK : OCTREE_NO_MEMORY;
}

octree_status insert_point(octree *tree, const octree_point *point)
{
    if (tree->root.count == UINT32_MAX)
        return OCTREE_TOO_MANY;
    const uint64_t code = morton_code(tree->axes, point->position);
    path way = path_to(tree, code);
    node *end = path_end(&way);
    const bool is_leaf = end->octants == 0;
    const octree_status status = is_leaf ? add_to_leaf(tree, end, point, code, way.depth)
                                         : add_child(tree, end, morton_octant(code, way.depth), point);
    if (status != OCTREE_OK)
        return status;
    const unsigned inner = is_leaf ? way.depth : way.depth + 1; /* a leaf has counted its point itself */
    for (unsigned i = 0; i < inner; i++)
        way.nodes[i]->count++;
    tree->version++;
    return OCTREE_OK;
}

octree_status octree_insert(octree *tree, const double position[3], uint64_t id)
{
    const octree_status status = check_position(tree, position);
    if (status != OCTREE_OK)
        return status;
    return insert_point(tree, &(octree_point){{position[0], position[1], position[2]}, id});
}
