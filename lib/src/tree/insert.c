/* insert.c - Algorithm 1: a point goes down to its leaf; a full leaf splits, refuses or grows. */
#include "insert.h"
#include "leaf.h"
#include "tune.h"

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

/* How many points of a full leaf, and of a new one, each octant of a cell receives. */
typedef struct shares {
    double planes[3]; /* that cut the cell */
    uint32_t counts[8];
    uint8_t mask;
} shares;

/* The octant of a position, by the planes that keys come from. */
static unsigned octant_of(const shares *s, const double p[3])
{
    return (unsigned)(p[0] >= s->planes[0]) << 2 | (unsigned)(p[1] >= s->planes[1]) << 1 |
           (unsigned)(p[2] >= s->planes[2]);
}

static void add_share(shares *s, const octree_point *point)
{
    const unsigned octant = octant_of(s, point->position);
    s->counts[octant]++;
    s->mask |= (uint8_t)(1u << octant);
}

static shares count_shares(const octree *tree, cell c, const node *full, const octree_point *point)
{
    shares s = {.mask = 0};
    for (int i = 0; i < 3; i++)
        s.planes[i] = plane_at(&tree->axes[i], c.low[i] + cell_size(c.depth + 1));
    for (uint32_t i = 0; i < full->count; i++)
        add_share(&s, &leaf_points(full)[i]);
    add_share(&s, point);
    return s;
}

/* From the cell of a full leaf down to the one in which its points and a new one come apart, or that holds them all and
 * cannot be divided. True in the first case. */
static bool find_parting(const octree *tree, const node *full, const octree_point *point, cell *c, shares *s)
{
    for (; may_split(tree, *c); *c = cell_child(*c, bits_lowest(s->mask))) {
        *s = count_shares(tree, *c, full, point);
        if (s->mask & (s->mask - 1))
            return true;
    }
    return false;
}

static bool make_leaves(octree *tree, node *group, const shares *s)
{
    for (unsigned octant = 0; octant < 8; octant++)
        if (s->counts[octant] && !leaf_create(tree, group++, s->counts[octant]))
            return false;
    return true;
}

/* An inner node whose leaves share the points of a full leaf and a new one. No memory: nothing is left behind. */
static bool make_parting(octree *tree, node *made, const node *full, const octree_point *point, const shares *s)
{
    const unsigned children = bits_count8(s->mask);
    node *group = pool_take(&tree->nodes, children);
    if (!group)
        return false;
    memset(group, 0, children * sizeof(node));
    *made = (node){.below = group, .count = full->count + 1, .octants = s->mask};
    if (!make_leaves(tree, group, s)) {
        node_release(tree, made);
        return false;
    }
    for (uint32_t i = 0; i < full->count; i++)
        leaf_put(child_at(made, octant_of(s, leaf_points(full)[i].position)), &leaf_points(full)[i]);
    leaf_put(child_at(made, octant_of(s, point->position)), point);
    return true;
}

/* A leaf of the points of a full leaf and a new one. */
static bool make_grown(octree *tree, node *made, const node *full, const octree_point *point)
{
    if (!leaf_create(tree, made, full->count + 1))
        return false;
    for (uint32_t i = 0; i < full->count; i++)
        leaf_put(made, &leaf_points(full)[i]);
    leaf_put(made, point);
    return true;
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
    cell bottom = path_cell(code, depth);
    shares s;
    const bool parts = find_parting(tree, leaf, point, &bottom, &s);
    if (!parts && tree->def.full_leaf == OCTREE_REFUSE)
        return OCTREE_FULL;
    if (!parts && bottom.depth == depth)
        return leaf_append(tree, leaf, point) ? OCTREE_OK : OCTREE_NO_MEMORY;
    node made;
    const bool enough = parts ? make_parting(tree, &made, leaf, point, &s) : make_grown(tree, &made, leaf, point);
    if (!enough || !make_chain(tree, &made, code, bottom.depth, depth))
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
    const octree_status inserted = insert_point(tree, &(octree_point){{position[0], position[1], position[2]}, id});
    tune_if_due(tree);
    return inserted;
}
