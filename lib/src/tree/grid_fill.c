/* SPDX-License-Identifier: MIT */
/* grid_fill.c - builds a tree from evenly spread points by counting them in a grid.
 *
 * Problem: building a tree of n points by sorting reads and writes the Morton code of each point several times.
 *
 * Idea: if points are spread evenly, counts of points determine the nodes. Choose a grid so fine that few of its cells
 * hold more points than a leaf. Count the points of each cell. Add the counts of eight cells to get the count of the
 * cell one level above. Make the nodes from the root down; a cell whose points fit one leaf becomes a leaf. Then write
 * each point straight into its leaf. Each point is read twice and written once, and the points of a leaf keep the
 * caller's order.
 *
 * Each task counts and writes its own share of the points. The counts of each task determine where the task's points
 * begin in each leaf, so that no two tasks write to the same place.
 *
 * A cell of the grid that holds more points than a leaf is a "crowd". The points of a crowd are sorted, and
 * restructure.c builds its nodes. A sample of the points decides beforehand whether there are few crowds; if not, all
 * points are sorted. Cost: O(n + cells), half the time of sorting.
 */
#include "grid_fill.h"
#include "division.h"

#include <string.h>

enum { SAMPLE_STEP = 16 }; /* choose_grid() looks at one point in 16 */

/* A crowd: a node with so many points in one grid cell that the node must be divided further than the grid. */
typedef struct crowd {
    node *at;
    cell cell;
    uint32_t count;
} crowd;

typedef struct filling {
    batch *whole;
    size_t count; /* the number of points: points of the batch, and copies of stored points */
    unsigned depth, tasks;
    uint32_t *counts[GRID_DEEPEST + 1]; /* counts[d][i] is the number of points in cell i of depth d */
    uint32_t *shares; /* for each task and each cell of the grid: the number of the task's points in the cell */
    /* for each task and each cell of the grid: the address to which the task writes its next point in the cell; null if
     * the cell is in a crowd */
    octree_point **next;
    list crowds;    /* a list of struct crowd, in Morton order */
    size_t crowded; /* the number of points in all cells that hold a crowd (see the head) */
} filling;

static size_t cell_count_at(unsigned depth)
{
    return (size_t)1 << 3 * depth;
}

/* Returns whether this many points fit into one leaf of at most POOL_MAX_UNITS points, which can be written without
 * sorting. */
static bool can_write_leaf_unsorted(const octree *tree, size_t count)
{
    return count <= POOL_MAX_UNITS && fits_leaf(tree, count);
}

/* ---- The grid -------------------------------------------------------------------------------------------------- */

/* Returns the number of sampled points that lie in crowded cells. A cell is crowded if it has more than `limit` sampled
 * points. The limit is twice the capacity of a leaf, scaled down to the sample. */
static size_t count_crowded_samples(const batch *b, unsigned depth, uint32_t *counts, size_t limit)
{
    const size_t stride = b->to ? 3 : sizeof *b->points / sizeof(double), samples = b->count / SAMPLE_STEP;
    const double *positions = b->to ? b->to[0] : b->points[0].position;
    size_t crowded = 0;
    memset(counts, 0, cell_count_at(depth) * sizeof *counts);
    for (size_t i = 0; i < samples; i += GRID_TOGETHER) {
        uint32_t cells[GRID_TOGETHER];
        const size_t count = samples - i < GRID_TOGETHER ? samples - i : GRID_TOGETHER;
        compute_grid_cells(b->tree->axes, depth, positions + i * SAMPLE_STEP * stride, SAMPLE_STEP * stride, count,
                           cells);
        for (size_t k = 0; k < count; k++)
            if (cells[k] != GRID_NONE)
                counts[cells[k]]++;
    }
    for (size_t i = 0; i < cell_count_at(depth); i++)
        crowded += counts[i] > limit ? counts[i] : 0;
    return crowded;
}

bool choose_grid(batch *b, size_t total)
{
    const octree_def *def = &b->tree->def;
    const size_t room = def->leaf_capacity < POOL_MAX_UNITS ? def->leaf_capacity : POOL_MAX_UNITS;
    unsigned depth = 1;
    while (total / 2 > room * cell_count_at(depth) / 3)
        depth++;
    for (; b->grid == 0 && depth <= GRID_DEEPEST && depth <= def->max_depth && cell_count_at(depth) <= total; depth++) {
        const size_t size = cell_count_at(depth) * sizeof(uint32_t);
        uint32_t *counts = arena_allocate(&b->store->memory, size);
        if (!counts)
            return false;
        const size_t crowded = count_crowded_samples(b, depth, counts, 2 * room * b->count / (total * SAMPLE_STEP) + 2);
        arena_free(&b->store->memory, counts, size);
        if (crowded <= b->count / SAMPLE_STEP / 8)
            b->grid = depth;
    }
    return true;
}

void find_grid_cells(const batch *b, const octree_point *points, size_t count, uint32_t *cells, octree_status *statuses)
{
    const octree *tree = b->tree;
    compute_grid_cells(tree->axes, b->grid, points->position, sizeof *points / sizeof(double), count, cells);
    for (size_t i = 0; i < count; i++) {
        const bool unsure = cells[i] == GRID_UNSURE;
        const octree_status status = unsure ? check_position(tree, points[i].position) : OCTREE_OK;
        if (unsure && status == OCTREE_OK)
            cells[i] = compute_grid_cell(tree->axes, b->grid, points[i].position);
        if (statuses)
            statuses[i] = status;
    }
}

/* Make items (Morton code and index) for a range of points. The range must lie in the caller's array or in the copies
 * of stored points, not in both. Returns the number of items made. */
static size_t append_grid_items(const batch *b, size_t first, size_t count, octree_point *const *filter,
                                morton_item *items)
{
    const bool is_new = first < b->count;
    const size_t place = is_new ? first : first - b->count;
    const octree_point *points = (is_new ? b->points : b->stored) + place;
    const bool moves = is_new && b->to;
    uint64_t codes[GRID_TOGETHER];
    size_t made = 0, wanted = 0;
    for (size_t i = first; i < first + count; i++)
        wanted += b->cells[i] != GRID_NONE && !(filter && filter[b->cells[i]]);
    if (wanted == 0)
        return 0;
    compute_morton_codes(b->tree->axes, moves ? b->to[place] : points->position,
                         moves ? 3 : sizeof *points / sizeof(double), count, codes);
    for (size_t i = 0; made < wanted; i++) {
        if (b->cells[first + i] == GRID_NONE || (filter && filter[b->cells[first + i]]))
            continue;
        const uint32_t at = (uint32_t)(place + i);
        const uint64_t code =
            codes[i] != MORTON_UNSURE ? codes[i] : morton_code(b->tree->axes, moves ? b->to[at] : points[i].position);
        items[made++] = is_new ? (morton_item){code, at, MORTON_NEW} : (morton_item){code, 0, at};
    }
    return made;
}

/* The state of tasks that make items (Morton code and index) for points. */
typedef struct item_making {
    const batch *whole;
    octree_point *const *filter;
    morton_item *items;
    unsigned tasks;
    size_t starts[TASKS_AT_MOST + 1]; /* the index of the first item of each task */
} item_making;

static size_t find_first_point_of_task(const item_making *m, size_t number)
{
    return find_share_start(m->whole->count + m->whole->stored_count, m->tasks, number);
}

/* Store the number of a task's items in starts[number + 1]. make_grid_items() then turns the numbers into indices. */
static void count_items_in_task(size_t number, void *context)
{
    item_making *m = context;
    const uint32_t *cells = m->whole->cells;
    const size_t end = find_first_point_of_task(m, number + 1);
    size_t count = 0;
    for (size_t i = find_first_point_of_task(m, number); i < end; i++)
        count += cells[i] != GRID_NONE && !(m->filter && m->filter[cells[i]]);
    m->starts[number + 1] = count;
}

static void make_items_in_task(size_t number, void *context)
{
    const item_making *m = context;
    const batch *b = m->whole;
    morton_item *next = m->items + m->starts[number];
    const size_t last = find_first_point_of_task(m, number + 1);
    for (size_t i = find_first_point_of_task(m, number), end; i < last; i = end) {
        const size_t most = i < b->count && b->count < last ? b->count : last;
        end = most - i < GRID_TOGETHER ? most : i + GRID_TOGETHER;
        next += append_grid_items(b, i, end - i, m->filter, next);
    }
}

size_t make_grid_items(const batch *b, octree_point *const *filter, morton_item *items)
{
    item_making m = {.whole = b, .filter = filter, .items = items};
    m.tasks = count_tasks(b->tree, b->count + b->stored_count);
    run_tasks(b->tree, count_items_in_task, m.tasks, &m);
    for (unsigned task = 0; task < m.tasks; task++)
        m.starts[task + 1] += m.starts[task];
    run_tasks(b->tree, make_items_in_task, m.tasks, &m);
    return m.starts[m.tasks];
}

/* ---- Counting ----------------------------------------------------------------------------------------------- */

static void count_points_in_task(size_t number, void *context)
{
    const filling *f = context;
    const uint32_t *cells = f->whole->cells;
    uint32_t *counts = f->shares + number * cell_count_at(f->depth);
    const size_t end = find_share_start(f->count, f->tasks, number + 1);
    for (size_t i = find_share_start(f->count, f->tasks, number); i < end; i++)
        if (cells[i] != GRID_NONE)
            counts[cells[i]]++;
}

static void sum_cell_counts(filling *f)
{
    const size_t cells = cell_count_at(f->depth);
    for (size_t i = 0; i < cells; i++)
        for (unsigned task = 0; task < f->tasks; task++)
            f->counts[f->depth][i] += f->shares[task * cells + i];
    for (unsigned depth = f->depth; depth-- > 0;)
        for (size_t i = 0; i < cell_count_at(depth + 1); i++)
            f->counts[depth][i / 8] += f->counts[depth + 1][i];
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

/* Set the addresses to which the points of a cell are written in the cell's leaf. In the leaf, the points of each grid
 * cell are adjacent and keep the caller's order. */
static void set_write_positions(filling *f, cell c, size_t index, octree_point *to)
{
    const size_t cells = cell_count_at(f->depth), width = cell_count_at(f->depth - c.depth);
    for (size_t i = index * width; i < (index + 1) * width; i++)
        for (unsigned task = 0; task < f->tasks; task++) {
            f->next[task * cells + i] = to;
            to += f->shares[task * cells + i];
        }
}

/* Returns whether the points of a cell must be sorted, so that build_node() builds the cell's node. This is so if the
 * points fill one leaf of more than POOL_MAX_UNITS points, if the grid is too coarse to divide the cell, if the cell
 * cannot split, or if leaves refuse points (OCTREE_REFUSE) and the points may be inseparable. */
static bool needs_sorting(const filling *f, cell c, size_t index)
{
    const octree *tree = f->whole->tree;
    const uint32_t count = f->counts[c.depth][index];
    if (c.depth == f->depth || fits_leaf(tree, count) || !can_split(tree, c))
        return true;
    const uint32_t *parts = f->counts[c.depth + 1] + 8 * index;
    for (unsigned octant = 0; octant < 8 && tree->def.full_leaf == OCTREE_REFUSE; octant++)
        if (parts[octant] == count)
            return true;
    return false;
}

static bool make_grid_node(filling *f, cell c, size_t index, node *made);

static bool make_grid_children(filling *f, cell c, size_t index, node *made)
{
    const uint32_t *parts = f->counts[c.depth + 1] + 8 * index;
    unsigned octants = 0;
    for (unsigned octant = 0; octant < 8; octant++)
        octants |= mask_if(parts[octant] > 0, 1u << octant);
    const unsigned children = bits_count8(octants);
    node *group = group_allocate(f->whole->store, children);
    *made = (node){.below = group, .count = f->counts[c.depth][index], .octants = (uint8_t)octants};
    if (!group)
        return false;
    memset(group, 0, children * sizeof *group);
    for (unsigned octant = 0; octant < 8; octant++)
        if (parts[octant] > 0 && !make_grid_node(f, cell_child(c, octant), 8 * index + octant, group++))
            return false;
    return true;
}

static bool make_grid_node(filling *f, cell c, size_t index, node *made)
{
    batch *b = f->whole;
    const uint32_t count = f->counts[c.depth][index];
    if (can_write_leaf_unsorted(b->tree, count)) {
        if (!leaf_create(b->store, made, count))
            return false;
        made->count = count;
        set_write_positions(f, c, index, leaf_points(made));
        return true;
    }
    if (!needs_sorting(f, c, index))
        return make_grid_children(f, c, index, made);
    const crowd found = {made, c, count};
    f->crowded += count;
    return list_push(&b->store->memory, &f->crowds, &found, sizeof found);
}

/* ---- Points ------------------------------------------------------------------------------------------------- */

/* Write points into their leaves. If `to` is not null, to[i] is the position of points[i]. */
static void write_points_to_leaves(const uint32_t *cells, const octree_point *points, const double (*to)[3],
                                   size_t count, octree_point **next)
{
    for (size_t i = 0; i < count; i++) {
        octree_point *at = cells[i] == GRID_NONE ? NULL : next[cells[i]];
        if (!at)
            continue;
        octree_point point = points[i];
        if (to)
            memcpy(point.position, to[i], sizeof point.position);
        *at = point;
        next[cells[i]] = at + 1;
    }
}

static void write_points_in_task(size_t number, void *context)
{
    const filling *f = context;
    const batch *b = f->whole;
    octree_point **next = f->next + number * cell_count_at(f->depth);
    const size_t first = find_share_start(f->count, f->tasks, number),
                 end = find_share_start(f->count, f->tasks, number + 1);
    /* The task's share may begin with points of the caller's array, up to `middle`. Copies of stored points follow. */
    const size_t middle = end < b->count ? end : first < b->count ? b->count : first;
    if (first < middle)
        write_points_to_leaves(b->cells + first, b->points + first, b->to ? b->to + first : NULL, middle - first, next);
    if (middle < end)
        write_points_to_leaves(b->cells + middle, b->stored + (middle - b->count), NULL, end - middle, next);
}

/* Correct the counts of a node and the nodes below it after leaves refused some points. Returns the node's count. */
static uint32_t recount_points_below(node *n)
{
    const unsigned children = bits_count8(n->octants);
    uint32_t sum = 0;
    for (unsigned i = 0; i < children; i++)
        sum += recount_points_below(&children_of(n)[i]);
    if (children > 0)
        n->count = sum;
    return n->count;
}

static bool build_crowded_cells(filling *f)
{
    batch *b = f->whole;
    const size_t size = 2 * f->crowded * sizeof(morton_item);
    morton_item *items = size ? arena_allocate(&b->store->memory, size) : NULL;
    if (!items)
        return size == 0;
    morton_item *rest = items;
    bool ok = true;
    const crowd *crowds = f->crowds.items;
    morton_sort(items, items + f->crowded, make_grid_items(b, f->next, items), 0, 0);
    for (size_t i = 0; ok && i < f->crowds.count; rest += crowds[i++].count)
        ok = build_node(b, crowds[i].cell, (span){rest, crowds[i].count}, crowds[i].at);
    arena_free(&b->store->memory, items, size);
    return ok;
}

static bool build_tree_from_counts(filling *f, node *made)
{
    const octree *tree = f->whole->tree;
    run_tasks(tree, count_points_in_task, f->tasks, f);
    sum_cell_counts(f);
    if (f->counts[0][0] == 0)
        return true;
    store_expect_points(f->whole->store, f->counts[0][0]);
    const bool ok = make_grid_node(f, root_cell(), 0, made);
    store_expect_points(f->whole->store, 0);
    if (!ok)
        return false;
    run_tasks(tree, write_points_in_task, f->tasks, f);
    if (!build_crowded_cells(f))
        return false;
    if (f->crowded > 0)
        recount_points_below(made);
    return true;
}

bool build_from_grid(batch *b, node *made)
{
    arena *memory = &b->store->memory;
    filling f = {.whole = b, .count = b->count + b->stored_count, .depth = b->grid};
    const size_t cells = cell_count_at(f.depth);
    /* Each task reads and writes a table of the cells. With more tasks than this, the tables would cost more time than
     * the points. */
    const size_t most = f.count / (8 * cells) + 1 < 2 ? 2 : f.count / (8 * cells) + 1;
    f.tasks = count_tasks(b->tree, f.count);
    f.tasks = f.tasks < most ? f.tasks : (unsigned)most;
    const size_t size = (cell_count_at(f.depth + 1) / 7 + f.tasks * cells) * sizeof *f.shares;
    const size_t next_size = f.tasks * cells * sizeof *f.next;
    f.shares = arena_allocate(memory, size);
    f.next = arena_allocate(memory, next_size);
    bool ok = f.shares && f.next;
    if (ok) {
        memset(f.shares, 0, size);
        memset(f.next, 0, next_size);
        f.counts[f.depth] = f.shares + f.tasks * cells;
        for (unsigned depth = f.depth; depth-- > 0;)
            f.counts[depth] = f.counts[depth + 1] + cell_count_at(depth + 1);
        ok = build_tree_from_counts(&f, made);
    }
    list_release(memory, &f.crowds, sizeof(crowd));
    arena_free(memory, f.shares, size);
    arena_free(memory, f.next, next_size);
    return ok;
}
