/* SPDX-License-Identifier: MIT */
/* nearest.c - Algorithms 6 and 7: the nearest points to a target, by exact distance.
 *
 * Problem: find the k nearest of n points while visiting as few nodes as possible. Every node whose box is nearer than
 * the k-th nearest point must be visited; no other node should be. The order of visits decides how soon the distance of
 * the k-th point is known.
 *
 * Idea: depth first, nearest octant first. The textbook descent measures every node on the way down. Here the bits of
 * the target's Morton code lead straight to the target's leaf, without any measuring. The search measures the nodes of
 * this path on the way back up. By then the best distance is small, and most siblings are out of reach. From the best
 * distance and the keys, count_nodes_out_of_reach() finds how many nodes of the path need no measuring at all.
 *
 * Order of siblings: a child's squared distance is a sum of one term per axis. The term is the parent's (near half) or
 * the squared distance to the splitting plane (far half). The eight sums are ordered like the subset sums of three
 * increments, so three comparisons sort them, and the first child out of reach ends the node.
 *
 * Cost: O(D + M) on average for points of bounded density, O(n) at worst. Source: the paper, Algorithms
 * 6 and 7; Samet (2006) on best-first and depth-first search. neighbor_heap.c keeps the results and decides near ties.
 */
#include "../exact/float_mode.h"
#include "../tree/leaf.h"
#include "../tree/morton_sort.h"
#include "neighbor_heap.h"
#include "search.h"
#include "../tree/tasks.h"

/* An inner node on the current path, whose children are being searched. */
typedef struct frame {
    const node *node;
    octree_address address;
    double center[3];     /* the centre of the node's cell, in units in which the world extends from -1 to 1 */
    double squares[3][2]; /* on each axis, the squared distance from the target to a child: [axis][0: near half, 1: far
                             half] */
    uint8_t near;         /* the octant whose cell is nearest to the target */
    uint8_t flips[8];     /* `octant ^ near` of each child, sorted by distance */
    uint8_t next;         /* the index of the next element of `flips` */
    uint8_t left;         /* bit mask of the octants that are not searched yet */
} frame;

typedef struct search {
    const octree *tree;
    neighbor_heap found;
    meter meter;
    double root_squares[3];         /* on each axis, the squared distance from the target to the world */
    unsigned open;                  /* the number of open frames; the innermost one has depth open - 1 */
    frame frames[OCTREE_MAX_DEPTH]; /* frames[d] is the frame of the path's node of depth d */
} search;

/* Swap two values, and the labels that belong to them, if the values are out of order. The code has no branches,
 * because branches would be unpredictable. */
static inline void sort_two_labeled(double *a, double *b, uint8_t *of_a, uint8_t *of_b)
{
    const double lesser = *b < *a ? *b : *a, greater = *b < *a ? *a : *b;
    const uint8_t change = (uint8_t)mask_if(*b < *a, *of_a ^ *of_b);
    *a = lesser;
    *b = greater;
    *of_a ^= change;
    *of_b ^= change;
}

/* Sort the octants by distance. An octant's distance is a sum of some of three increments a <= b <= c. The eight sums
 * ascend as 0, a, b, min(c, a + b), and then the complements of these four in reverse order. */
static void sort_octants_by_distance(frame *f)
{
    double a = f->squares[0][1] - f->squares[0][0];
    double b = f->squares[1][1] - f->squares[1][0];
    double c = f->squares[2][1] - f->squares[2][0];
    uint8_t bit_a = 4, bit_b = 2, bit_c = 1;
    sort_two_labeled(&a, &b, &bit_a, &bit_b);
    sort_two_labeled(&b, &c, &bit_b, &bit_c);
    sort_two_labeled(&a, &b, &bit_a, &bit_b);
    f->flips[0] = 0;
    f->flips[1] = bit_a;
    f->flips[2] = bit_b;
    f->flips[3] = a + b < c ? bit_a | bit_b : bit_c;
    for (int i = 0; i < 4; i++)
        f->flips[7 - i] = 7 ^ f->flips[i];
}

/* Measure the distances from the target to the planes that split a frame's cell. The cell's centre and the squares of
 * the near halves are already set. */
static void measure_planes(const search *s, frame *f)
{
    f->near = 0;
    for (int i = 0; i < 3; i++) {
        const double plane = metric_scaled(&s->found.metric, plane_inside(&s->tree->axes[i], f->center[i]));
        const double beyond = s->found.metric.scaled[i] - plane;
        f->squares[i][1] = beyond * beyond;
        f->near |= beyond >= 0 ? 4 >> i : 0;
    }
}

static void open_child_frame(search *s, unsigned flip, const node *child)
{
    const frame *parent = &s->frames[s->open - 1];
    frame *f = &s->frames[s->open];
    const unsigned octant = parent->near ^ flip;
    const double half = 1.0 / (double)(1u << s->open++), sides[2] = {-half, half};
    for (int i = 0; i < 3; i++) {
        f->center[i] = parent->center[i] + sides[octant >> (2 - i) & 1];
        f->squares[i][0] = parent->squares[i][flip >> (2 - i) & 1];
    }
    f->node = child;
    f->address = parent->address << 3 | octant;
    f->next = 0;
    f->left = child->octants;
    measure_planes(s, f);
    sort_octants_by_distance(f);
}

static void scan_points(search *s, const octree_point *points, unsigned count)
{
    neighbor_heap *found = &s->found;
    double squares[SCAN_POINTS];
    const metric_scan scan = metric_scan_points(&found->metric, points, count, found->point_reach, squares);
    const double reach = neighbor_heap_reach(found, scan.least);
    uint64_t left = scan.within;
    if (reach < found->point_reach && (left & (left - 1)))
        left = metric_mask_within(squares, count, reach);
    for (; left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        if (!(squares[i] > found->point_reach))
            neighbor_heap_add(found, &points[i], squares[i]);
    }
}

static void scan_leaf(search *s, const node *leaf)
{
    s->meter.count.leaves++;
    s->meter.count.points += leaf->count;
    for (uint32_t i = 0; i < leaf->count; i += SCAN_POINTS)
        scan_points(s, leaf_points(leaf) + i, leaf->count - i < SCAN_POINTS ? leaf->count - i : SCAN_POINTS);
}

static double squared_distance_to_child(const frame *f, unsigned flip)
{
    return (f->squares[0][flip >> 2] + f->squares[1][flip >> 1 & 1]) + f->squares[2][flip & 1];
}

/* Search the nearest unsearched child of the innermost node. If no such child is within reach, close the node. */
static void search_next_child(search *s)
{
    frame *f = &s->frames[s->open - 1];
    while (f->left) {
        const unsigned flip = f->flips[f->next], octant = f->near ^ flip;
        if (f->left >> octant & 1) {
            if (squared_distance_to_child(f, flip) > s->found.node_reach)
                break;
            const node *child = &children_of(f->node)[child_index(f->node, octant)];
            f->left &= ~(1u << octant);
            f->next++;
            meter_visit(&s->meter, f->address << 3 | octant);
            if (child->octants) {
                open_child_frame(s, flip, child);
                return;
            }
            scan_leaf(s, child);
        } else {
            f->next++;
        }
    }
    meter_prune(&s->meter, f->address, f->left);
    s->open--;
}

/* Fill the frame of a node on the path to the target's leaf. The octant that is on this path counts as already
 * searched. */
static frame *open_path_node(search *s, const node *n, uint64_t code, const uint32_t keys[3], unsigned depth)
{
    frame *f = &s->frames[depth];
    const uint32_t half = cell_size(depth + 1);
    for (int i = 0; i < 3; i++) {
        f->center[i] = (double)((keys[i] & ~(2 * half - 1)) + half) * 0x1p-20 - 1;
        f->squares[i][0] = s->root_squares[i];
    }
    f->node = n;
    f->address = morton_address(code, depth);
    measure_planes(s, f);
    f->near = (uint8_t)morton_octant(code, depth);
    f->next = 1;
    f->left = n->octants & ~(1u << f->near);
    return f;
}

/* Search those octants of a node that are not on the path to the target's leaf. Usually all these octants are out of
 * reach. */
static void search_siblings(search *s, frame *f, unsigned depth)
{
    const double reach = s->found.node_reach;
    const double x = squared_distance_to_child(f, 4), y = squared_distance_to_child(f, 2),
                 z = squared_distance_to_child(f, 1);
    /* A single branch: three branches, one per axis, would be unpredictable. */
    if ((x > reach) & (y > reach) & (z > reach)) {
        meter_prune(&s->meter, f->address, f->left);
        return;
    }
    sort_octants_by_distance(f);
    s->open = depth + 1;
    while (s->open > depth)
        search_next_child(s);
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

/* Store the keys of the target's position after clamping it to the world. */
static void find_nearest_keys(const octree *tree, const double target[3], uint32_t keys[3])
{
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        keys[i] = plane_key(a, target[i] < a->min ? a->min : target[i] > a->max ? a->max : target[i]);
    }
}

/* Return the number of nodes on the path to the target's leaf, from the root down, whose splitting planes are all out
 * of reach of the target.
 *
 * The number is 20 minus the highest bit in which the keys of target - reach and target + reach differ on any axis. The
 * reach in keys is widened by the error of the keys plus two. The result is 0 if the keys are not reliable or the
 * target is outside the world. */
static unsigned count_nodes_out_of_reach(const search *s, const uint32_t keys[3])
{
    const double reach = sqrt(s->found.node_reach) / s->found.metric.scale;
    uint32_t differ = 0;
    for (int i = 0; i < 3; i++) {
        const axis *a = &s->tree->axes[i];
        const double width = reach * a->keys_per_unit + a->guess_error + 2;
        if (!(width < PLANE_GRID) || !(a->keys_per_unit > 0) || a->subnormal || s->root_squares[i] > 0)
            return 0;
        const uint32_t wide = (uint32_t)width + 1, low = keys[i] > wide ? keys[i] - wide : 0;
        const uint32_t high = keys[i] + wide < PLANE_GRID ? keys[i] + wide : PLANE_GRID - 1;
        differ |= low ^ high;
    }
    return OCTREE_MAX_DEPTH - 1 - bits_highest(differ); /* `differ` is not 0, because low < high on every axis */
}

static void search_from_root(search *s)
{
    const octree *tree = s->tree;
    uint32_t keys[3];
    double squares = 0;
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        const double gap = metric_gap(&s->found.metric, i, a->min, a->max);
        s->root_squares[i] = gap * gap;
        squares += s->root_squares[i];
    }
    if (squares > s->found.node_reach) {
        meter_prune_root(&s->meter);
        return;
    }
    find_nearest_keys(tree, s->found.metric.target, keys);
    const uint64_t code = morton_interleave(keys);
    const path p = find_path(tree, code);
    s->meter.count.nodes += p.depth + 1;
    for (unsigned depth = 0; s->meter.how->trace && depth <= p.depth; depth++)
        meter_trace(&s->meter, morton_address(code, depth), OCTREE_TRACE_VISITED);
    unsigned depth = p.depth;
    if (p.nodes[depth]->octants) {
        depth++; /* no node exists for the target's octant, so all children of this node are searched like siblings */
    } else {
        leaf_prefetch(p.nodes[depth]);
        prefetch_adjacent_leaves(&p, code, keys, s->found.k);
        scan_leaf(s, p.nodes[depth]);
    }
    const unsigned first_near = count_nodes_out_of_reach(s, keys);
    while (depth-- > 0)
        if (depth >= first_near)
            search_siblings(s, open_path_node(s, p.nodes[depth], code, keys, depth), depth);
        else
            meter_prune(&s->meter, morton_address(code, depth),
                        p.nodes[depth]->octants & ~(1u << morton_octant(code, depth)));
}

#define NO_RADIUS (-1.0)

/* Search the tree. The arguments are valid and k >= 1. Returns the number of points found. */
static size_t search_tree(const octree *tree, const double target[3], size_t k, double radius, const octree_search *how,
                          octree_neighbor *neighbors)
{
    search s;
    s.tree = tree;
    s.found.metric = metric_make(tree->scale, is_subnormal_world(tree), target);
    neighbor_heap_begin(&s.found, how, radius, neighbors, k);
    s.meter = (meter){.how = how};
    s.open = 0;
    const unsigned begun = how->trace ? begin_callbacks(tree) : 0;
    search_from_root(&s);
    if (how->trace)
        end_callbacks(begun);
    neighbor_heap_finish(&s.found);
    meter_report(&s.meter);
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
    const octree_search search = search_or_default(how);
    octree_status status = check_finite_position(target);
    if (status == OCTREE_OK)
        status = check_search_options(&search);
    if (status == OCTREE_OK && k > 0)
        *count = search_tree(tree, target, k, radius, &search, neighbors);
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

/* Array elements are prefetched this many targets before they are used. Targets are searched in Morton order, which
 * jumps around in the caller's arrays. */
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

static void find_codes_of_share(size_t number, void *context)
{
    const target_batch *b = context;
    for (size_t i = find_share_start(b->count, b->tasks, number); i < find_share_start(b->count, b->tasks, number + 1);
         i++) {
        uint32_t keys[3];
        find_nearest_keys(b->tree, b->targets[i], keys);
        b->order[i] = (morton_item){morton_interleave(keys), (uint32_t)i, MORTON_NEW};
    }
}

static void search_targets_of_share(size_t number, void *context)
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
    run_tasks(b->tree, find_codes_of_share, b->tasks, b);
    morton_sort_tasks(b->tree, memory, b->order, b->order + b->count, b->count, 0, false);
    /* With a tracer there is only one task, because the caller's tracer need not be thread-safe. */
    if (b->how.trace)
        b->tasks = 1;
    run_tasks(b->tree, search_targets_of_share, b->tasks, b);
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
