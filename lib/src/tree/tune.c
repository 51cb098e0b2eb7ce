/* SPDX-License-Identifier: MIT */
/* tune.c - chooses the leaf capacity by a cost model: octree_tune().
 *
 * Problem: the best capacity depends on the points and on how the tree is used: small leaves suit searches, large
 * leaves suit changes and ranges. Timing trial trees would make the choice differ between machines and runs.
 *
 * Idea: count instead of timing. Build trees with capacities 4, 8 ... 256 on a sample, run the operations of the mix on
 * each, and compare weighted counts of visited inner nodes, leaves and points. The weights are fitted to measured times
 * once; only their ratios matter. The sample consists of whole cells, copied with all their points, because a random
 * sample would thin the points out and change their density. Cost: seven bulk builds of at most 40,000 points, 128
 * operations of each kind per capacity, and one rebuild.
 */
#include "../exact/float_mode.h"
#include "tree.h"

#include <math.h>
#include <stdlib.h>

/* ---- The model ---------------------------------------------------------------------------------------------- */

/* Costs in nanoseconds: of entering an inner node, of entering a leaf, and of reading a point. The costs were fitted to
 * the times of all operations on 5e4 and 1e6 uniform, gaussian, clustered and surface points, at capacities from 1 to
 * 128. The fit gave 30, 15 and 1 ns for trees within the caches, and 32, 23 and less than 1 ns for larger trees. */
static const double inner_weight = 30, leaf_weight = 20, point_weight = 1;

static double weighted_cost(const octree_cost *cost)
{
    return inner_weight * (double)(cost->nodes - cost->leaves) + leaf_weight * (double)cost->leaves +
           point_weight * (double)cost->points;
}

enum { LEAST_CAPACITY = 4, MOST_CAPACITY = 256 };

/* ---- A sample of whole cells, with the density of the tree --------------------------------------------- */

/* A cell of the sample has at most 16 points for each result of a query; this limit is clamped to LEAST_CELL ..
 * MOST_CELL. In a cell of this size, a range around a point stays mostly inside the cell. The larger the cells are, the
 * fewer cells are sampled. */
enum { LEAST_CELL = 4096, MOST_CELL = 32768, TARGETS = 128 };

static size_t choose_points_per_cell(const octree_mix *mix)
{
    const size_t most = mix->k > mix->hits ? mix->k : mix->hits;
    return most >= MOST_CELL / 16 ? MOST_CELL : most <= LEAST_CELL / 16 ? LEAST_CELL : 16 * most;
}

typedef struct sample {
    octree_point *points;
    size_t count, room;
    octree_mix mix;
    octree_neighbor *neighbors; /* an array with room for the results of any search of the mix */
    double extents[TARGETS];    /* for each target, half the side of the box of the range query around the target */
} sample;

static bool add_sample_point(const octree_point *point, void *context)
{
    sample *s = context;
    if (s->count < s->room)
        s->points[s->count++] = *point;
    return s->count < s->room;
}

/* The state of the walk that selects cells for the sample. If the tree has more points than the sample can hold, the
 * walk selects one cell in every `step` points. */
typedef struct cell_picker {
    sample *sample;
    const octree *tree;
    size_t cell; /* the maximum number of points in a selected cell */
    size_t points_before, step;
} cell_picker;

/* An octree_node_visitor: if the node's cell is selected, copy its points to the sample. Also copy the points on the
 * cell's upper faces, although these points belong to neighbouring cells. */
static octree_walk_order copy_selected_cell(const octree_node *seen, void *context)
{
    cell_picker *p = context;
    if (!seen->leaf && seen->count > p->cell)
        return OCTREE_WALK_ON;
    const size_t before = p->points_before;
    p->points_before += seen->count;
    if (before / p->step != p->points_before / p->step)
        octree_range(p->tree, &seen->box, add_sample_point, p->sample);
    return OCTREE_WALK_SKIP;
}

static bool make_sample(sample *s, octree *tree)
{
    const size_t count = octree_count(tree), cell = choose_points_per_cell(&s->mix);
    s->room = count < 2 * MOST_CELL ? count : 2 * MOST_CELL;
    s->points = arena_allocate(&tree->store.memory, s->room * sizeof *s->points);
    if (!s->points)
        return false;
    octree_walk(tree, copy_selected_cell,
                &(cell_picker){s, tree, cell, 0, count <= s->room ? 1 : count / (MOST_CELL / cell)});
    /* sort the points, so that the sample does not depend on their order in leaves */
    qsort(s->points, s->count, sizeof *s->points, octree_compare_points);
    return true;
}

static const octree_point *sample_target(const sample *s, size_t i)
{
    return &s->points[i * s->count / TARGETS];
}

/* ---- Trials ------------------------------------------------------------------------------------------------- */

/* For each target, find the ball that contains `hits` points, and store half the side of the cube with the same volume.
 * The searches cannot fail. */
static void measure_ranges(sample *s, const octree *trial)
{
    for (size_t i = 0; i < TARGETS; i++) {
        size_t found = 0;
        octree_nearest_k(trial, sample_target(s, i)->position, s->mix.hits, NULL, s->neighbors, &found);
        s->extents[i] = found ? 0.806 * s->neighbors[found - 1].distance : 0;
    }
}

static octree_cost cost_of_change(const octree *trial, const octree_point *target)
{
    octree_node leaf;
    octree_locate(trial, target->position, &leaf);
    return (octree_cost){.nodes = leaf.depth + 1, .leaves = 1, .points = leaf.count};
}

static octree_cost cost_of_nearest(const sample *s, const octree *trial, const octree_point *target)
{
    octree_cost cost = {0};
    size_t found;
    const octree_search how = {.skip = OCTREE_SKIP_ID, .skip_id = target->id, .cost = &cost};
    octree_nearest_k(trial, target->position, s->mix.k, &how, s->neighbors, &found);
    return cost;
}

/* The cost of a range search. octree_cost does not count a node that is taken whole, or the nodes below it; the tracer
 * add_cost_of_taken_node() adds these nodes. */
typedef struct range_cost {
    const octree *trial;
    octree_cost all;
} range_cost;

static void add_cost_of_nodes_below(octree_cost *cost, const node *n)
{
    cost->nodes++;
    cost->leaves += n->octants == 0;
    for (unsigned i = bits_count8(n->octants); i-- > 0;)
        add_cost_of_nodes_below(cost, &children_of(n)[i]);
}

static void add_cost_of_taken_node(octree_address address, octree_trace_kind touch, void *context)
{
    range_cost *r = context;
    if (touch != OCTREE_TRACE_TAKEN)
        return;
    const path p = find_path(r->trial, morton_of_address(address));
    add_cost_of_nodes_below(&r->all, p.nodes[octree_address_depth(address)]);
}

static octree_cost cost_of_range(const octree *trial, const octree_point *target, double extent)
{
    range_cost r = {.trial = trial};
    const octree_search how = {.cost = &r.all, .trace = add_cost_of_taken_node, .trace_context = &r};
    octree_box box;
    size_t found;
    if (octree_collision_box(target->position, extent, &box) == OCTREE_OK)
        octree_range_collect(trial, &box, &how, NULL, 0, &found);
    return r.all;
}

/* Returns the cost of the mix of operations in a trial tree. */
static double cost_of_mix(const sample *s, const octree *trial)
{
    double sum = 0;
    for (size_t i = 0; i < TARGETS; i++) {
        const octree_point *target = sample_target(s, i);
        const octree_cost change = cost_of_change(trial, target), nearest = cost_of_nearest(s, trial, target);
        const octree_cost range = cost_of_range(trial, target, s->extents[i]);
        sum += s->mix.changes * weighted_cost(&change) + s->mix.nearest * weighted_cost(&nearest) +
               s->mix.ranges * weighted_cost(&range);
    }
    return sum;
}

static octree_status try_capacity(sample *s, octree_def def, double *cost)
{
    octree *trial;
    octree_status status = octree_create(&def, &trial);
    if (status == OCTREE_OK)
        status = octree_insert_many(trial, s->points, s->count, NULL, NULL);
    if (status == OCTREE_OK) {
        if (def.leaf_capacity == LEAST_CAPACITY)
            measure_ranges(s, trial);
        *cost = cost_of_mix(s, trial);
    }
    octree_destroy(trial);
    return status;
}

static octree_status choose_capacity(sample *s, octree_def def, size_t *capacity)
{
    double least = INFINITY, cost = 0;
    for (def.leaf_capacity = LEAST_CAPACITY; def.leaf_capacity <= MOST_CAPACITY; def.leaf_capacity *= 2) {
        const octree_status status = try_capacity(s, def, &cost);
        if (status != OCTREE_OK)
            return status;
        if (cost < least) {
            least = cost;
            *capacity = def.leaf_capacity;
        }
    }
    return OCTREE_OK;
}

/* ---- The choice --------------------------------------------------------------------------------------------- */

octree_mix octree_mix_default(void)
{
    return (octree_mix){.changes = 1, .nearest = 1, .k = 1, .ranges = 1, .hits = 10};
}

static octree_status check_mix(const octree_mix *mix)
{
    if (!isfinite(mix->changes) || !isfinite(mix->nearest) || !isfinite(mix->ranges))
        return OCTREE_NOT_FINITE;
    const bool none = mix->changes == 0 && mix->nearest == 0 && mix->ranges == 0;
    return none || mix->changes < 0 || mix->nearest < 0 || mix->ranges < 0 ? OCTREE_BAD_SIZE : OCTREE_OK;
}

/* Divide the shares of the mix by the largest share. The division cannot overflow, and cannot make all shares 0. Limit
 * k and `hits` to the size of the sample. */
static octree_mix normalize_mix(octree_mix mix, size_t most)
{
    const double largest = fmax(fmax(mix.changes, mix.nearest), mix.ranges);
    mix.changes /= largest;
    mix.nearest /= largest;
    mix.ranges /= largest;
    mix.k = mix.k < most ? mix.k : most;
    mix.hits = mix.hits < most ? mix.hits : most;
    return mix;
}

static octree_status choose_capacity_by_sample(octree *tree, const octree_mix *mix, size_t *capacity)
{
    sample s = {.mix = normalize_mix(*mix, LEAST_CELL)};
    arena *memory = &tree->store.memory;
    const size_t size = ((s.mix.k > s.mix.hits ? s.mix.k : s.mix.hits) + 1) * sizeof *s.neighbors;
    /* while the executor of `tree` runs tasks of the trial trees, changes of `tree` return BUSY */
    const unsigned begun = begin_callbacks(tree);
    s.neighbors = arena_allocate(memory, size);
    const bool ok = s.neighbors && make_sample(&s, tree);
    const octree_status status = ok ? choose_capacity(&s, tree->def, capacity) : OCTREE_NO_MEMORY;
    end_callbacks(begun);
    arena_free(memory, s.neighbors, size);
    arena_free(memory, s.points, s.room * sizeof *s.points);
    return status;
}

octree_status octree_tune(octree *tree, const octree_mix *mix)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_tune, tree, mix);
    if (!tree)
        return OCTREE_NULL_ARGUMENT;
    if (tree->def.full_leaf != OCTREE_GROW)
        return OCTREE_BAD_CAPACITY;
    const octree_mix asked = mix ? *mix : octree_mix_default();
    octree_def def = tree->def;
    octree_status status = is_running_callback(tree) ? OCTREE_BUSY : check_mix(&asked);
    /* a tree without points gets the default capacity */
    def.leaf_capacity = octree_def_default().leaf_capacity;
    if (status == OCTREE_OK && octree_count(tree) > 0)
        status = choose_capacity_by_sample(tree, &asked, &def.leaf_capacity);
    if (status == OCTREE_OK && def.leaf_capacity != tree->def.leaf_capacity)
        status = rebuild_tree(tree, &def);
    if (status == OCTREE_OK)
        tree->tuning.mix = asked;
    return status;
}
