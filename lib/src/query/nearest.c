/* SPDX-License-Identifier: MIT */
/* nearest.c - Algorithms 6 and 7: the nearest points to a target, by exact distance.
 *
 * Problem: find the k nearest of n points while visiting as few nodes as possible. Every node whose box is nearer than
 * the k-th nearest point must be visited; no other node should be. The order of visits decides how soon the distance of
 * the k-th point is known.
 *
 * Idea: depth first, nearest octant first. The textbook descent measures every node on the way down. Here the bits of
 * the target's Morton code lead straight to the target's leaf, without computing any distance. (The code is made of
 * three keys, one per axis: the numbers of the grid cells that contain the target's coordinates, see plane.h.) The
 * search measures the nodes of this path on the way back up. By then the best distance is small, and most siblings are
 * out of reach. count_nodes_out_of_reach() finds how many nodes of the path need no measuring at all.
 *
 * Distances to planes: in units of keys, the position of every plane is a whole number, so a distance is the difference
 * of this number and the target's position in keys. The difference has a known error, by which the reach of nodes is
 * widened (limit_of_node_distance() in neighbor_heap.c). In worlds where keys may be wrong, and for targets outside the
 * world, the coordinates of the planes are computed instead.
 *
 * Order of siblings: a child's squared distance is a sum of one term per axis. On an axis where the child is in the
 * half near the target, the term is the parent's term; in the far half, it is the squared distance to the splitting
 * plane. The eight sums are ordered like the subset sums of three increments, so a few comparisons select their order
 * from a table. The first child that is out of reach ends the search of the node, because all later children are
 * farther.
 *
 * Cost: O(D + M) on average for points of bounded density, O(n) at worst. Source: the paper, Algorithms 6 and 7; Samet
 * (2006) on best-first and depth-first search. neighbor_heap.c keeps the results and decides near ties.
 */
#include "../exact/float_mode.h"
#include "../tree/leaf.h"
#include "../tree/morton_sort.h"
#include "neighbor_heap.h"
#include "search.h"
#include "../tree/tasks.h"

enum { CACHED = 300000 }; /* a tree with fewer points fits into a processor's caches, where prefetching gains nothing */

/* An inner node within reach (it may contain one of the k nearest points), and its distances from the target. */
typedef struct branch {
    const node *node;
    octree_address address;
    double center[3]; /* the splitting planes of the node's cell, in keys */
    double half;      /* half of the cell's size, in keys */
    /* on each axis, the squared distance from the target to the octants: [axis][0: near half, 1: far half] */
    double squares[3][2];
} branch;

typedef struct search {
    const octree *tree;
    neighbor_heap found;
    meter meter;
    bool is_metered; /* true: the caller wants the cost or a trace of the search */
    /* true: distances to planes are differences of keys; false: they are differences of coordinates */
    bool is_in_keys;
    double place[3];             /* the target's position in keys; valid only if is_in_keys is true */
    double root_squares[3];      /* on each axis, the squared distance from the target to the world */
    double squares[SCAN_POINTS]; /* the squared distances of the points that are being scanned */
    /* a stack: a node on the path to the target's leaf, and the nodes of the current descent below it */
    branch branches[OCTREE_MAX_DEPTH];
} search;

/* The octants of a node in ascending order of distance, each as `octant ^ near`, where `near` is the octant nearest to
 * the target. The far half on an axis adds an increment to the squared distance. a, b and c are the octant bits of the
 * axes with the least, the middle and the greatest increment. d is the fourth element, a | b or c. */
#define ORDER_ROW(a, b, c, d)                                                                                          \
    {                                                                                                                  \
        0, a, b, d, 7 ^ (d), 7 ^ (b), 7 ^ (a), 7                                                                       \
    }
#define ORDER_ROWS(a, b, c)                                                                                            \
    {                                                                                                                  \
        ORDER_ROW(a, b, c, c), ORDER_ROW(a, b, c, (a) | (b))                                                           \
    }
typedef const uint8_t octant_order[8];
static octant_order orders[8][2] = {
    ORDER_ROWS(4, 2, 1), ORDER_ROWS(2, 4, 1), ORDER_ROWS(4, 1, 2), ORDER_ROWS(4, 2, 1),
    ORDER_ROWS(4, 2, 1), ORDER_ROWS(2, 1, 4), ORDER_ROWS(1, 4, 2), ORDER_ROWS(1, 2, 4),
};

/* Returns the order of the octants. The first index of the table has a bit for each of three comparisons; two of the
 * eight values cannot occur. An octant's distance is a sum of some of three increments a <= b <= c. The eight sums
 * ascend as 0, a, b, min(c, a + b), and then the complements of these four in reverse order. */
static inline const uint8_t *find_octant_order(const branch *b)
{
    const double x = b->squares[0][1] - b->squares[0][0];
    const double y = b->squares[1][1] - b->squares[1][0];
    const double z = b->squares[2][1] - b->squares[2][0];
    const double most = larger(larger(x, y), z);
    return orders[(y < x) | (z < y) << 1 | (z < x) << 2][(x + y) + z < 2 * most];
}

/* Store in b->squares[i][1] the squared distance from the target to the plane that splits the cell on axis i: the
 * distance to the half on the other side of the plane. Returns the octant that is nearest to the target. */
static inline unsigned measure_planes(const search *s, branch *b)
{
    unsigned below = 0;
    for (int i = 0; i < 3; i++) {
        double beyond, unit = 1;
        if (s->is_in_keys) {
            beyond = s->place[i] - b->center[i];
            unit = s->tree->key_squares[i];
        } else {
            const double plane = plane_inside(&s->tree->axes[i], b->center[i] * 0x1p-20 - 1);
            beyond = s->found.metric.scaled[i] - metric_scaled(&s->found.metric, plane);
        }
        b->squares[i][1] = beyond * beyond * unit;
        below = 2 * below + is_negative(beyond);
    }
    return 7 ^ below;
}

static inline void scan_leaf(search *s, const node *leaf)
{
    const octree_point *points = leaf_points(leaf);
    if (RARELY(s->is_metered)) {
        s->meter.count.leaves++;
        s->meter.count.points += leaf->count;
    }
    for (uint32_t left = leaf->count, count; left > 0; left -= count, points += count) {
        count = left < SCAN_POINTS ? left : SCAN_POINTS;
        const double least = metric_compute_squares(&s->found.metric, points, count, s->squares);
        if (!(least > s->found.point_reach)) {
            const double reach = neighbor_heap_reach(&s->found, s->squares, count, least);
            neighbor_heap_add(&s->found, points, s->squares, metric_mask_within(s->squares, count, reach));
        }
    }
}

/* Returns the squared distance from the target to an octant of a branch's cell. `flip` is that octant ^ the octant
 * nearest to the target. */
static inline double squared_distance_to_octant(const branch *b, unsigned flip)
{
    return (b->squares[0][flip >> 2] + b->squares[1][flip >> 1 & 1]) + b->squares[2][flip & 1];
}

/* For each octant and axis, the half of the cell in which the octant lies: -1 for the lower half, 1 for the upper
 * half. */
static const double sides[8][3] = {{-1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {-1, 1, 1},
                                   {1, -1, -1},  {1, -1, 1},  {1, 1, -1},  {1, 1, 1}};

/* Make the branch of a node's child in an octant; `flip` is that octant ^ the octant nearest to the target.
 * measure_planes() must then store the distances to the child's splitting planes. */
static inline void make_child_branch(const branch *parent, const node *child, unsigned octant, unsigned flip, branch *b)
{
    b->node = child;
    b->address = parent->address << 3 | octant;
    b->half = parent->half / 2;
    for (int i = 0; i < 3; i++) {
        b->center[i] = parent->center[i] + sides[octant][i] * b->half;
        b->squares[i][0] = parent->squares[i][flip >> (2 - i) & 1];
    }
}

/* Search the children of node b->node in the octants of the bit mask `left`, nearest first, until a child is out of
 * reach. `near` is the octant that is nearest to the target. b[1] is used for the branch of a child. */
static void search_octants(search *s, branch *b, unsigned near, unsigned left)
{
    const uint8_t *flips = find_octant_order(b);
    for (; left; flips++) {
        const unsigned flip = *flips, octant = near ^ flip;
        if (!(left >> octant & 1))
            continue;
        if (squared_distance_to_octant(b, flip) > s->found.node_reach)
            break;
        const node *child = look_up_child(b->node, octant);
        left &= ~(1u << octant);
        if (RARELY(s->is_metered))
            meter_record_visited(&s->meter, b->address << 3 | octant);
        if (child->octants) {
            make_child_branch(b, child, octant, flip, b + 1);
            search_octants(s, b + 1, measure_planes(s, b + 1), child->octants);
        } else {
            scan_leaf(s, child);
        }
    }
    if (RARELY(s->is_metered))
        meter_record_pruned(&s->meter, b->address, left);
}

/* Search the children of a node that are not on the path to the target's leaf. Usually all these children are out of
 * reach. */
static inline void search_siblings(search *s, const node *n, uint64_t code, const uint32_t keys[3], unsigned depth)
{
    const double reach = s->found.node_reach;
    const uint32_t half = cell_size(depth + 1);
    const unsigned near = morton_octant(code, depth), left = n->octants & ~(1u << near);
    branch *b = s->branches;
    b->node = n;
    b->address = morton_address(code, depth);
    b->half = (double)(int32_t)half;
    for (int i = 0; i < 3; i++) {
        b->center[i] = (double)(int32_t)((keys[i] & ~(2 * half - 1)) + half);
        b->squares[i][0] = s->root_squares[i];
    }
    measure_planes(s, b);
    const double x = squared_distance_to_octant(b, 4), y = squared_distance_to_octant(b, 2),
                 z = squared_distance_to_octant(b, 1);
    /* A single branch: three branches, one per axis, would be unpredictable. */
    if (!((x > reach) & (y > reach) & (z > reach)))
        search_octants(s, b, near, left);
    else if (RARELY(s->is_metered))
        meter_record_pruned(&s->meter, b->address, left);
}

/* Find the cells adjacent to the target's cell that the search will probably visit, and store their Morton codes. Such
 * a cell is at most a quarter of the cell size away from the target if k = 1, and at most half of the cell size if k >
 * 1. Returns the number of codes. */
static unsigned find_adjacent_codes(const uint32_t keys[3], unsigned depth, size_t k, uint64_t codes[3])
{
    const uint32_t size = cell_size(depth), close = k > 1 ? size / 2 : size / 4;
    unsigned count = 0;
    for (int i = 0; i < 3; i++) {
        const uint32_t within = keys[i] & (size - 1);
        uint32_t beside[3] = {keys[0], keys[1], keys[2]};
        if (within < close)
            beside[i] -= size;
        else if (within >= size - close)
            beside[i] += size;
        /* A key below 0 has wrapped around to a large unsigned number, which this test excludes. */
        if (beside[i] != keys[i] && beside[i] < PLANE_GRID)
            codes[count++] = morton_interleave(beside);
    }
    return count;
}

/* Prefetch the leaves adjacent to the target's leaf, while the processor loads the target's leaf from memory. */
static void prefetch_adjacent_leaves(const path *p, uint64_t code, const uint32_t keys[3], size_t k)
{
    uint64_t codes[3];
    const unsigned count = find_adjacent_codes(keys, p->depth, k, codes);
    for (unsigned i = 0; i < count; i++) {
        unsigned depth = p->depth;
        while ((codes[i] ^ code) >> 3 * (OCTREE_MAX_DEPTH - depth))
            depth--;
        const node *n = p->nodes[depth];
        while (n && n->octants)
            n = child_at(n, morton_octant(codes[i], depth++));
        if (n)
            leaf_prefetch(n);
    }
}

/* Store the keys of the target, clamped to the world, in keys[]. */
static void find_clamped_keys(const octree *tree, const double target[3], uint32_t keys[3])
{
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        keys[i] = plane_key(a, target[i] < a->min ? a->min : target[i] > a->max ? a->max : target[i]);
    }
}

/* Returns the number of nodes on the path to the target's leaf, from the root down, whose splitting planes are all out
 * of reach of the target. So the other children of these nodes are out of reach, too.
 *
 * The number is 20 minus the highest bit in which the keys of target - reach and target + reach differ on any axis. The
 * reach in keys is widened, to cover rounding. The result is 0 if distances are not in keys. */
static unsigned count_nodes_out_of_reach(const search *s, const uint32_t keys[3])
{
    const double reach = sqrt(s->found.node_reach);
    uint32_t differ = 1;
    for (int i = 0; i < 3; i++) {
        /* The 3 covers the error of the target's key (below 1/2), and the rounding of the key and of the width to
         * integers (below 1 each). */
        const double width = reach * s->tree->axes[i].keys_per_unit + 3;
        if (!(width < PLANE_GRID) || !s->is_in_keys)
            return 0;
        const int32_t key = (int32_t)keys[i], wide = (int32_t)width, low = key - wide, high = key + wide;
        differ |=
            (uint32_t)(low > 0 ? low : 0) ^ (uint32_t)(high < (int32_t)PLANE_GRID ? high : (int32_t)PLANE_GRID - 1);
    }
    return OCTREE_MAX_DEPTH - 1 - bits_highest(differ);
}

/* Search the siblings of the path to the target's leaf, from the children of the path's node of depth `depth` - 1
 * upwards, up to the nodes whose splitting planes are out of reach. */
static inline void search_path_upwards(search *s, const path *p, uint64_t code, const uint32_t keys[3], unsigned depth)
{
    const unsigned first_near = count_nodes_out_of_reach(s, keys);
    while (depth > first_near) {
        depth--;
        search_siblings(s, p->nodes[depth], code, keys, depth);
    }
    while (s->is_metered && depth-- > 0)
        meter_record_pruned(&s->meter, morton_address(code, depth),
                            p->nodes[depth]->octants & ~(1u << morton_octant(code, depth)));
}

/* Find the path to a code, as find_path() does, but inline. Returns the path's last node. */
static inline const node *descend_along_path(const octree *tree, uint64_t code, path *p)
{
    const node *n = &tree->root;
    begin_path(p, (octree *)(uintptr_t)tree);
    while (n->octants) {
        const unsigned octant = morton_octant(code, p->depth);
        if (!(n->octants >> octant & 1))
            break;
        p->nodes[++p->depth] = look_up_child(n, octant);
        n = path_end(p);
    }
    return n;
}

/* Search the leaf whose cell contains the target's keys, then the siblings of the path to this leaf, from the leaf
 * up. */
static inline void search_from_leaf(search *s, const uint32_t keys[3])
{
    const octree *tree = s->tree;
    const uint64_t code = morton_interleave(keys);
    path p;
    const node *end = descend_along_path(tree, code, &p);
    s->meter.count.nodes += p.depth + 1;
    for (unsigned i = 0; s->meter.how->trace && i <= p.depth; i++)
        meter_call_tracer(&s->meter, morton_address(code, i), OCTREE_TRACE_VISITED);
    unsigned depth = p.depth;
    if (end->octants) {
        /* no node exists for the target's octant, so all children of the path's last node are siblings of the path */
        depth++;
    } else {
        if (tree->root.count > CACHED) {
            leaf_prefetch(end);
            prefetch_adjacent_leaves(&p, code, keys, s->found.k);
        }
        scan_leaf(s, end);
    }
    search_path_upwards(s, &p, code, keys, depth);
}

/* Store the keys of the target, clamped to the world, in keys[], and set root_squares. Returns false if the world is
 * out of reach. */
static bool find_keys_from_planes(search *s, uint32_t keys[3])
{
    const octree *tree = s->tree;
    double squares = 0;
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        const double gap = metric_interval_distance(&s->found.metric, i, a->min, a->max);
        s->root_squares[i] = gap * gap;
        squares += s->root_squares[i];
    }
    find_clamped_keys(tree, s->found.metric.target, keys);
    return !(squares > s->found.node_reach);
}

/* Convert a target in the world to keys, the integer coordinates of the finest cells, rounded down. A key may be off by
 * one, which does no harm: the search may begin at any leaf near the target. */
static inline void guess_keys(search *s, uint32_t keys[3])
{
    for (int i = 0; i < 3; i++) {
        const axis *a = &s->tree->axes[i];
        s->place[i] = (s->found.metric.target[i] - a->min) * a->keys_per_unit;
        const int32_t key = (int32_t)s->place[i];
        keys[i] = key < (int32_t)PLANE_GRID ? (uint32_t)key : PLANE_GRID - 1;
        s->root_squares[i] = 0;
    }
}

static inline void search_from_root(search *s)
{
    uint32_t keys[3];
    bool is_near = true;
    if (s->is_in_keys)
        guess_keys(s, keys);
    else
        is_near = find_keys_from_planes(s, keys);
    if (is_near)
        search_from_leaf(s, keys);
    else
        meter_record_pruned_root(&s->meter);
}

#define NO_RADIUS (-1.0)

/* Search the tree. The arguments are valid and k >= 1. Returns the number of points found. */
static size_t search_tree(const octree *tree, const double target[3], size_t k, double radius, const octree_search *how,
                          octree_neighbor *neighbors)
{
    search s;
    s.tree = tree;
    s.is_in_keys = tree->has_key_squares && box_contains(&tree->def.world, target);
    metric_set(&s.found.metric, tree->scale, is_subnormal_world(tree), target);
    s.found.node_error = s.is_in_keys ? tree->key_error : 0;
    neighbor_heap_begin(&s.found, how, radius, neighbors, k);
    s.meter = (meter){.how = how};
    s.is_metered = how->cost || how->trace;
    const unsigned begun = how->trace ? begin_callbacks(tree) : 0;
    search_from_root(&s);
    if (how->trace)
        end_callbacks(begun);
    neighbor_heap_finish(&s.found);
    meter_add_to_cost(&s.meter);
    return s.found.count;
}

static octree_status check_and_search(const octree *tree, const double target[3], size_t k, double radius,
                                      const octree_search *how, octree_neighbor *neighbors, size_t *count)
{
    if (!count)
        return OCTREE_NULL_ARGUMENT;
    *count = 0;
    if (!tree || !target || (!neighbors && k > 0))
        return OCTREE_NULL_ARGUMENT;
    static const octree_search none = {0};
    how = how ? how : &none;
    octree_status status = check_finite_position(target);
    if (status == OCTREE_OK)
        status = check_search_options(how);
    if (status == OCTREE_OK && k > 0)
        *count = search_tree(tree, target, k, radius, how, neighbors);
    return status;
}

octree_status octree_nearest_k(const octree *tree, const double target[3], size_t k, const octree_search *how,
                               octree_neighbor *neighbors, size_t *count)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_nearest_k, tree, target, k, CALLER_SEARCH(how), neighbors, count);
    return check_and_search(tree, target, k, NO_RADIUS, how, neighbors, count);
}

octree_status octree_nearest_within(const octree *tree, const double target[3], double radius, const octree_search *how,
                                    octree_neighbor *nearest)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_nearest_within, tree, target, radius, CALLER_SEARCH(how), nearest);
    size_t count = 0;
    octree_status status = check_length(radius);
    if (status == OCTREE_OK)
        status = check_and_search(tree, target, 1, radius, how, nearest, &count);
    return status == OCTREE_OK && count == 0 ? OCTREE_NOT_FOUND : status;
}

octree_status octree_nearest(const octree *tree, const double target[3], octree_skip skip, uint64_t skip_id,
                             octree_neighbor *nearest)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_nearest, tree, target, skip, skip_id, nearest);
    const octree_search how = {.skip = skip, .skip_id = skip_id};
    size_t count;
    const octree_status status = check_and_search(tree, target, 1, NO_RADIUS, &how, nearest, &count);
    return status == OCTREE_OK && count == 0 ? OCTREE_NOT_FOUND : status;
}

/* ---- Many targets, in the order of the tree ----------------------------------------------------------------- */

static octree_status check_batch_arguments(const octree *tree, const double (*targets)[3], size_t count,
                                           const octree_search *how, const octree_neighbor *neighbors)
{
    if (!tree || ((!targets || !neighbors) && count))
        return OCTREE_NULL_ARGUMENT;
    if (count > UINT32_MAX)
        return OCTREE_TOO_MANY;
    octree_status status = check_search_options(how);
    for (size_t i = 0; status == OCTREE_OK && i < count; i++)
        status = check_finite_position(targets[i]);
    return status;
}

/* The elements of the caller's arrays are prefetched this many targets before they are used. Targets are searched in
 * Morton order, so the processor cannot predict the next element. */
#define PREFETCH_AHEAD 4

typedef struct target_batch {
    const octree *tree;
    const double (*targets)[3];
    size_t count;
    octree_search how;
    octree_neighbor *neighbors;
    bool *found;
    morton_item *order;
    unsigned tasks;
    octree_cost costs[TASKS_AT_MOST];
} target_batch;

static void find_codes_in_task(size_t number, void *context)
{
    const target_batch *b = context;
    for (size_t i = find_share_start(b->count, b->tasks, number); i < find_share_start(b->count, b->tasks, number + 1);
         i++) {
        uint32_t keys[3];
        find_clamped_keys(b->tree, b->targets[i], keys);
        b->order[i] = (morton_item){morton_interleave(keys), (uint32_t)i, MORTON_NEW};
    }
}

static void search_targets_in_task(size_t number, void *context)
{
    target_batch *b = context;
    const size_t end = find_share_start(b->count, b->tasks, number + 1);
    octree_search how = b->how;
    how.cost = how.cost ? &b->costs[number] : NULL;
    for (size_t i = find_share_start(b->count, b->tasks, number); i < end; i++) {
        octree_neighbor nearest;
        const uint32_t place = b->order[i].place;
        if (i + PREFETCH_AHEAD < end) {
            prefetch_memory(&b->targets[b->order[i + PREFETCH_AHEAD].place]);
            prefetch_memory(&b->neighbors[b->order[i + PREFETCH_AHEAD].place]);
        }
        const bool one = search_tree(b->tree, b->targets[place], 1, NO_RADIUS, &how, &nearest) == 1;
        if (one)
            b->neighbors[place] = nearest;
        if (b->found)
            b->found[place] = one;
    }
}

static void search_in_morton_order(target_batch *b, arena *memory)
{
    run_tasks(b->tree, find_codes_in_task, b->tasks, b);
    morton_sort_by_tasks(b->tree, memory, b->order, b->order + b->count, b->count, 0, false);
    /* With a tracer there is only one task, because the caller's tracer need not be thread-safe. */
    if (b->how.trace)
        b->tasks = 1;
    run_tasks(b->tree, search_targets_in_task, b->tasks, b);
    for (unsigned i = 0; b->how.cost && i < b->tasks; i++)
        add_cost(b->how.cost, &b->costs[i]);
}

octree_status octree_nearest_batch(const octree *tree, const double (*targets)[3], size_t count,
                                   const octree_search *how, octree_neighbor *neighbors, bool *found)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_nearest_batch, tree, targets, count, CALLER_SEARCH(how), neighbors,
                           found);
    const octree_search search = search_or_default(how);
    const octree_status status = check_batch_arguments(tree, targets, count, &search, neighbors);
    if (status != OCTREE_OK || count == 0)
        return status;
    /* a separate arena, because queries must not change the byte count in the tree's arena */
    arena memory = {.allocator = tree->def.allocator};
    target_batch b = {tree, targets, count, search, neighbors, found, .tasks = count_tasks(tree, count)};
    const size_t size = count <= SIZE_MAX / 2 / sizeof(morton_item) ? 2 * count * sizeof(morton_item) : SIZE_MAX;
    b.order = size < SIZE_MAX ? arena_allocate(&memory, size) : NULL;
    if (!b.order)
        return OCTREE_NO_MEMORY;
    search_in_morton_order(&b, &memory);
    arena_free(&memory, b.order, size);
    return OCTREE_OK;
}
