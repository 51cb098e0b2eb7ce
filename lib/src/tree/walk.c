/* SPDX-License-Identifier: MIT */
/* walk.c - traversals of all nodes: octree_walk(), octree_check(), octree_statistics() and octree_digest(). */
#include "walk.h"
#include "../exact/exact.h"
#include "../exact/float_mode.h"
#include "tasks.h"

static octree_node describe_node(const node *n, octree_address address, unsigned depth, const octree_box *bounds)
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

/* Prefetch the children or points of each child, because a large tree does not fit into the caches. */
static void prefetch_children(const node *n)
{
    const unsigned children = bits_count8(n->octants);
    for (unsigned i = 0; i < children; i++)
        prefetch_node(&children_of(n)[i]);
}

/* Store the splitting planes of a cell in middle[]. */
static inline void find_splitting_planes(const octree *tree, cell c, double middle[3])
{
    for (int i = 0; i < 3; i++)
        middle[i] = plane_at(&tree->axes[i], c.low[i] + cell_size(c.depth + 1));
}

static inline octree_box octant_box(const octree_box *box, const double middle[3], unsigned octant)
{
    octree_box below = *box;
    for (int i = 0; i < 3; i++)
        *(octant & (4u >> i) ? &below.min[i] : &below.max[i]) = middle[i];
    return below;
}

/* Visit a node and the nodes below it. Returns false if the visitor has stopped the walk. */
static bool walk_subtree(walk *w, const node *n, octree_address address, cell c, const octree_box *box)
{
    const octree_node description = describe_node(n, address, c.depth, box);
    const octree_walk_order order = w->visit(&description, w->context);
    if (order != OCTREE_WALK_ON || !n->octants)
        return order != OCTREE_WALK_STOP;
    prefetch_children(n);
    double middle[3];
    find_splitting_planes(w->tree, c, middle);
    const node *child = children_of(n);
    for (unsigned left = n->octants; left; left &= left - 1) {
        const unsigned octant = bits_lowest(left);
        const octree_box below = octant_box(box, middle, octant);
        if (!walk_subtree(w, child++, address << 3 | octant, cell_child(c, octant), &below))
            return false;
    }
    return true;
}

octree_status octree_walk(const octree *tree, octree_node_visitor visit, void *context)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_walk, tree, CALLER_NODE_VISITOR(visit, context));
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    walk w = {.tree = tree, .visit = visit, .context = context};
    const unsigned begun = begin_callbacks(tree);
    walk_subtree(&w, &tree->root, OCTREE_ROOT, root_cell(), &tree->def.world);
    end_callbacks(begun);
    return OCTREE_OK;
}

/* Returns a description of the node at this depth on the path to a code. */
static octree_node describe_path_node(const octree *tree, const path *p, uint64_t code, unsigned depth)
{
    const octree_box bounds = cell_bounds(tree->axes, morton_cell(code, depth));
    return describe_node(p->nodes[depth], morton_address(code, depth), depth, &bounds);
}

octree_status octree_node_at(const octree *tree, octree_address address, octree_node *result)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_node_at, tree, address, result);
    if (!tree || !result)
        return OCTREE_NULL_ARGUMENT;
    if (!is_address(address))
        return OCTREE_NOT_FOUND;
    const unsigned depth = octree_address_depth(address);
    const uint64_t code = morton_of_address(address);
    const path p = find_path(tree, code);
    if (p.depth < depth)
        return OCTREE_NOT_FOUND;
    *result = describe_path_node(tree, &p, code, depth);
    return OCTREE_OK;
}

octree_status octree_locate(const octree *tree, const double position[3], octree_node *result)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_locate, tree, position, result);
    const octree_status status = result ? check_position(tree, position) : OCTREE_NULL_ARGUMENT;
    if (status != OCTREE_OK)
        return status;
    const uint64_t code = morton_code(tree->axes, position);
    const path p = find_path(tree, code);
    *result = describe_path_node(tree, &p, code, p.depth);
    return OCTREE_OK;
}

/* ---- The validator ------------------------------------------------------------------------------------------ */

static const char *check_inner_node(const octree *tree, const node *n, cell c)
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
        return "an inner node has so few points that it should be a leaf";
    if (!can_split(tree, c))
        return "an inner node is deeper than the tree allows";
    return NULL;
}

/* Returns the closed box in which the points of a leaf lie. A cell does not contain its upper planes, except planes on
 * the world's upper faces. */
static octree_box closed_box_of_cell(octree_box box, cell c)
{
    for (int i = 0; i < 3; i++)
        if (c.low[i] + cell_size(c.depth) != PLANE_GRID)
            box.max[i] = exact_step_down(box.max[i]);
    return box;
}

/* Returns whether the point at an index of a leaf is also stored at a lower index. Ids are compared first, because they
 * usually differ. */
static bool is_stored_twice(const node *n, uint32_t index)
{
    const octree_point *points = leaf_points(n), *point = &points[index];
    if (n->room == LEAF_HASHED)
        return leaf_find(n, point->position, point->id) != index;
    for (uint32_t i = 0; i < index; i++)
        if (points[i].id == point->id && is_same_position(points[i].position, point->position))
            return true;
    return false;
}

static const char *check_leaf(const octree *tree, const node *n, cell c, const octree_box *bounds)
{
    const octree_box box = closed_box_of_cell(*bounds, c);
    if (!fits_leaf(tree, n->count) && can_split(tree, c))
        return "a leaf that could split is over its capacity";
    if (!fits_leaf(tree, n->count) && tree->def.full_leaf == OCTREE_REFUSE)
        return "a leaf is over its capacity under OCTREE_REFUSE";
    for (uint32_t i = 0; i < n->count; i++) {
        const double *position = leaf_points(n)[i].position;
        if (!box_contains(&box, position))
            return box_contains(&tree->def.world, position) ? "a point is not in its leaf's cell"
                                                            : "a point is outside the world";
        if (is_stored_twice(n, i))
            return "a pair of position and id is stored twice";
    }
    return NULL;
}

typedef struct validation {
    const octree *tree;
    const char *broken; /* a sentence about the first violated invariant; null: no invariant is violated */
    octree_address where;
} validation;

/* Check a node and the nodes below it, in the order of octree_walk(). No visitor is used, because calls of a visitor
 * would double the time. */
static void check_subtree(validation *v, const node *n, octree_address address, cell c, const octree_box *box)
{
    v->broken = n->octants ? check_inner_node(v->tree, n, c) : check_leaf(v->tree, n, c, box);
    v->where = address;
    if (v->broken || !n->octants)
        return;
    prefetch_children(n);
    double middle[3];
    find_splitting_planes(v->tree, c, middle);
    const node *child = children_of(n);
    for (unsigned left = n->octants; left && !v->broken; left &= left - 1) {
        const unsigned octant = bits_lowest(left);
        const octree_box below = octant_box(box, middle, octant);
        check_subtree(v, child++, address << 3 | octant, cell_child(c, octant), &below);
    }
}

/* Keep the earlier of two violations: the one whose node comes first in the order of the walk. */
static void keep_first_violation(validation *first, const char *broken, octree_address where)
{
    if (broken && (!first->broken || compare_addresses(&where, &first->where) < 0)) {
        first->broken = broken;
        first->where = where;
    }
}

/* The state of tasks that check or digest all nodes of a tree. */
typedef struct reading {
    forest forest;
    /* first[i] is the first violation that task i found; first[forest.tasks] is the first violation in the nodes above
     * the subtrees */
    validation first[TASKS_AT_MOST + 1];
    /* sums[i] is the sum of the digests of the nodes that task i reads; sums[forest.tasks] is the sum of the nodes
     * above the subtrees */
    uint64_t sums[TASKS_AT_MOST + 1];
} reading;

/* Check a node before it is divided into its children. Returns false if the node violates an invariant, because its
 * children may then be invalid pointers. */
static bool check_divided_node(const subtree *s, void *context)
{
    reading *r = context;
    const char *broken = check_inner_node(r->forest.tree, s->node, s->cell);
    keep_first_violation(&r->first[r->forest.tasks], broken, s->address);
    return !broken;
}

static void check_subtrees_in_task(size_t number, void *context)
{
    reading *r = context;
    const octree *tree = r->forest.tree;
    const subtree *end = first_subtree(&r->forest, number + 1);
    for (const subtree *s = first_subtree(&r->forest, number); s < end; s++) {
        const octree_box box = cell_bounds(tree->axes, s->cell);
        validation v = {.tree = tree};
        check_subtree(&v, s->node, s->address, s->cell, &box);
        keep_first_violation(&r->first[number], v.broken, v.where);
    }
}

const char *octree_check(const octree *tree, octree_address *where)
{
    RETURN_IN_DEFAULT_MODE(const char *, octree_check, tree, where);
    if (!tree)
        return "there is no tree";
    reading r;
    memset(r.first, 0, sizeof r.first);
    divide_tree(&r.forest, tree, check_divided_node, &r);
    run_tasks(tree, check_subtrees_in_task, r.forest.tasks, &r);
    validation *first = &r.first[r.forest.tasks];
    for (unsigned i = 0; i < r.forest.tasks; i++)
        keep_first_violation(first, r.first[i].broken, r.first[i].where);
    if (first->broken && where)
        *where = first->where;
    return first->broken;
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

static void count_nodes_below(octree_stats *stats, const node *n, unsigned depth)
{
    const unsigned children = bits_count8(n->octants);
    const node *child = children_of(n);
    for (unsigned i = 0; i < children; i++, child++) {
        count_node(stats, child, depth + 1);
        if (child->octants)
            count_nodes_below(stats, child, depth + 1);
    }
}

octree_status octree_statistics(const octree *tree, octree_stats *stats)
{
    if (!tree || !stats)
        return OCTREE_NULL_ARGUMENT;
    *stats = (octree_stats){.points = tree->root.count, .memory = tree->store.memory.bytes};
    count_node(stats, &tree->root, 0);
    count_nodes_below(stats, &tree->root, 0);
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

/* Returns the sum of the digests of an inner node and all nodes below it. */
static uint64_t sum_digests_below(const node *n, octree_address address)
{
    uint64_t sum = digest_node(n, address);
    const node *child = children_of(n);
    prefetch_below(n);
    for (unsigned left = n->octants; left; left &= left - 1) {
        const unsigned octant = bits_lowest(left);
        const octree_address at = address << 3 | octant;
        sum += child->octants ? sum_digests_below(child, at) : digest_node(child, at);
        child++;
    }
    return sum;
}

uint64_t digest_of_definition(const octree_def *def, uint64_t sum)
{
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, sum);
    digest = octree_digest_word(digest, def->leaf_capacity);
    digest = octree_digest_word(digest, def->max_depth);
    for (int i = 0; i < 3; i++) {
        digest = octree_digest_double(digest, def->world.min[i]);
        digest = octree_digest_double(digest, def->world.max[i]);
    }
    return digest;
}

uint64_t digest_of_tree(const octree *tree, uint64_t sum)
{
    return digest_of_definition(&tree->def, sum);
}

static bool digest_divided_node(const subtree *s, void *context)
{
    reading *r = context;
    r->sums[r->forest.tasks] += digest_node(s->node, s->address);
    return true;
}

static void digest_subtrees_in_task(size_t number, void *context)
{
    reading *r = context;
    const subtree *end = first_subtree(&r->forest, number + 1);
    for (const subtree *s = first_subtree(&r->forest, number); s < end; s++)
        r->sums[number] += s->node->octants ? sum_digests_below(s->node, s->address) : digest_node(s->node, s->address);
}

uint64_t octree_digest(const octree *tree)
{
    if (!tree)
        return 0;
    reading r;
    memset(r.sums, 0, sizeof r.sums);
    divide_tree(&r.forest, tree, digest_divided_node, &r);
    run_tasks(tree, digest_subtrees_in_task, r.forest.tasks, &r);
    uint64_t sum = 0;
    for (unsigned i = 0; i <= r.forest.tasks; i++)
        sum += r.sums[i];
    return digest_of_tree(tree, sum);
}
