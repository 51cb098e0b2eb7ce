#include "walk.h"
#include "float_rules.h"

static octree_node describe(const node *n, octree_address address, unsigned depth, const octree_box *bounds)
{
    return (octree_node){
        .address = address,
        .depth = depth,
        .leaf = n->octants == 0,
        .octants = n->octants,
        .box = *bounds,
        .count = n->count,
        .points = n->octants ? NULL : leaf_points(n),
    };
}

typedef struct walk {
    const octree *tree;
    octree_node_visitor visit;
    void *context;
} walk;

/* A large tree does not fit the caches: what is below each child is loaded before it is visited. */
static void prefetch_children(const node *n)
{
    const unsigned children = bits_count8(n->octants);
    for (unsigned i = 0; i < children; i++) {
        const node *child = &children_of(n)[i];
        if (child->octants)
            prefetch(child->below);
        else
            leaf_prefetch(child);
    }
}

/* Visit a node and what is below it. False when the visitor has stopped the walk. */
static bool walk_below(const walk *w, const node *n, octree_address address, cell c, const octree_box *box)
{
    const octree_node seen = describe(n, address, c.depth, box);
    const octree_walk_order order = w->visit(&seen, w->context);
    if (order != OCTREE_WALK_ON || !n->octants)
        return order != OCTREE_WALK_STOP;
    prefetch_children(n);
    double middle[3];
    for (int i = 0; i < 3; i++)
        middle[i] = plane_at(&w->tree->axes[i], c.low[i] + cell_size(c.depth + 1));
    const node *child = children_of(n);
    for (unsigned octant = 0; octant < 8; octant++) {
        if (!(n->octants >> octant & 1))
            continue;
        octree_box below = *box;
        for (int i = 0; i < 3; i++)
            *(octant & (4u >> i) ? &below.min[i] : &below.max[i]) = middle[i];
        if (!walk_below(w, child++, address << 3 | octant, cell_child(c, octant), &below))
            return false;
    }
    return true;
}

octree_status octree_walk(const octree *tree, octree_node_visitor visit, void *context)
{
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    walk_below(&(walk){tree, visit, context}, &tree->root, OCTREE_ROOT, root_cell(), &tree->def.world);
    return OCTREE_OK;
}

octree_status octree_node_at(const octree *tree, octree_address address, octree_node *result)
{
    if (!tree || !result)
        return OCTREE_NULL_ARGUMENT;
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    if (!is_address(address))
        return OCTREE_NOT_FOUND;
    const unsigned depth = octree_address_depth(address);
    const uint64_t code = morton_of_address(address);
    const path p = path_to(tree, code);
    if (p.depth < depth)
        return OCTREE_NOT_FOUND;
    const octree_box bounds = cell_bounds(tree->axes, morton_cell(code, depth));
    *result = describe(p.nodes[depth], address, depth, &bounds);
    return OCTREE_OK;
}

octree_status octree_locate(const octree *tree, const double position[3], octree_node *result)
{
    const octree_status status = result ? check_position(tree, position) : OCTREE_NULL_ARGUMENT;
    if (status != OCTREE_OK)
        return status;
    const uint64_t code = morton_code(tree->axes, position);
    const path p = path_to(tree, code);
    const octree_box bounds = cell_bounds(tree->axes, morton_cell(code, p.depth));
    *result = describe(path_end(&p), morton_address(code, p.depth), p.depth, &bounds);
    return OCTREE_OK;
}

/* ---- Statistics --------------------------------------------------------------------------------------------- */

void count_node(octree_stats *stats, const node *n, unsigned depth)
{
    stats->nodes++;
    stats->nodes_at_depth[depth]++;
    stats->depth = depth > stats->depth ? depth : stats->depth;
    if (n->octants == 0) {
        stats->leaves++;
        stats->leaves_at_depth[depth]++;
        stats->largest_leaf = n->count > stats->largest_leaf ? n->count : stats->largest_leaf;
    }
}

static void count_below(octree_stats *stats, const node *n, unsigned depth)
{
    const unsigned children = bits_count8(n->octants);
    const node *child = children_of(n);
    for (unsigned i = 0; i < children; i++, child++) {
        count_node(stats, child, depth + 1);
        if (child->octants)
            count_below(stats, child, depth + 1);
    }
}

octree_status octree_statistics(const octree *tree, octree_stats *stats)
{
    if (!tree || !stats)
        return OCTREE_NULL_ARGUMENT;
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    *stats = (octree_stats){.points = tree->root.count, .memory = tree->store.memory.bytes};
    count_node(stats, &tree->root, 0);
    count_below(stats, &tree->root, 0);
    return OCTREE_OK;
}

/* ---- The digest --------------------------------------------------------------------------------------------- */

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

/* Of an inner node and all below it. */
static uint64_t digest_below(const node *n, octree_address address)
{
    uint64_t sum = digest_node(n, address);
    const node *child = children_of(n);
    prefetch_below(n);
    for (unsigned octant = 0; octant < 8; octant++) {
        if (!(n->octants >> octant & 1))
            continue;
        const octree_address at = address << 3 | octant;
        sum += child->octants ? digest_below(child, at) : digest_node(child, at);
        child++;
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
    return tree && float_mode_is_default() ? digest_of_sum(tree, digest_below(&tree->root, OCTREE_ROOT)) : 0;
}
