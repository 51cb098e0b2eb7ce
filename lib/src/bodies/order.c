/* SPDX-License-Identifier: MIT */
/* order.c - many bodies in the order of the cells of a grid, and the floor of their set.
 *
 * A counting sort by the cells of a grid brings neighbours together, in O(n). Its counts also tell how deep the leaves
 * will be, before there is a tree: a leaf is the largest cell that holds at most as many bodies as the capacity.
 *
 * The floor is the size up to which bodies share one level (level.c). A body enlarges the boxes of its leaf and of the
 * nodes above (boxes.c), and an own level for it costs one more descent. The floor is 3/2 of the cell of a leaf, at a
 * depth that nine of ten bodies' leaves do not exceed, so that sparse regions do not slow down dense ones. Measured in
 * instructions, with 1e5 uniform bodies: beside a floor of 3/8 of a cell, sizes over three decades are searched in 15
 * to 27 % fewer, and streets in 10 to 17 %. If all bodies are small, but one in 20 has 1.3 cells, a search takes 1.7
 * times as many; with a floor of 5/2 of a cell, decades up to such sizes would take 1.2 times as many.
 */
#include "order.h"
#include "../query/search.h"

/* The least number of bodies that are sorted before they are added to others. */
enum { LEAST_SORTED = 1024 };

/* Counting sort. Bodies of one cell keep their order; so, of two equal bodies, the first is added. Bodies whose cell is
 * not certain come last. */
static void sort_by_cells(const octree_bodies *set, const octree_body *added, size_t count, const row_order *order)
{
    uint32_t *cells = order->indices + count, *ends = order->ends;
    const uint32_t last = UINT32_C(1) << 3 * order->depth;
    memset(ends, 0, (last + 2) * sizeof *ends);
    compute_grid_cells(anchor_of(set)->axes, order->depth, added->position, sizeof *added / sizeof(double), count,
                       cells);
    for (size_t i = 0; i < count; i++) {
        cells[i] = cells[i] < last ? cells[i] : last;
        ends[cells[i] + 1]++;
    }
    for (uint32_t i = 1; i < last + 2; i++)
        ends[i] += ends[i - 1];
    for (size_t i = 0; i < count; i++)
        order->indices[ends[cells[i]]++] = (uint32_t)i;
}

row_order make_order(octree_bodies *set, const octree_body *added, size_t count)
{
    row_order order = {.depth = 1};
    if (count == 0 || (count < LEAST_SORTED && set->rows.count > 0))
        return order;
    while (order.depth < GRID_DEEPEST && (size_t)1 << 3 * (order.depth + 1) <= count)
        order.depth++;
    order.size = (2 * count + ((size_t)1 << 3 * order.depth) + 2) * sizeof *order.indices;
    order.indices = arena_allocate(&set->memory, order.size);
    if (!order.indices)
        return order;
    order.ends = order.indices + 2 * count;
    sort_by_cells(set, added, count, &order);
    return order;
}

void free_order(octree_bodies *set, const row_order *order)
{
    arena_free(&set->memory, order->indices, order->size);
}

/* ---- The floor ---------------------------------------------------------------------------------------------- */

/* Add the number of bodies in a cell to the depths that their leaves will have in one tree. Below the grid, each level
 * is assumed to divide the bodies by 4, as on a surface. */
static void count_by_depth(const row_order *order, size_t capacity, unsigned depth, uint32_t cell,
                           size_t counts[OCTREE_MAX_DEPTH + 1])
{
    const unsigned shift = 3 * (order->depth - depth);
    const uint32_t begin = cell << shift, end = (cell + 1) << shift;
    const size_t count = order->ends[end - 1] - (begin > 0 ? order->ends[begin - 1] : 0);
    if (count > capacity && depth < order->depth) {
        for (uint32_t octant = 0; octant < 8; octant++)
            count_by_depth(order, capacity, depth + 1, cell << 3 | octant, counts);
        return;
    }
    for (size_t left = count; left > capacity && depth < OCTREE_MAX_DEPTH; left /= 4)
        depth++;
    counts[depth] += count;
}

void choose_floor(octree_bodies *set, const row_order *order, size_t count)
{
    const size_t sure = order->ends[(UINT32_C(1) << 3 * order->depth) - 1]; /* the bodies whose cell is certain */
    size_t counts[OCTREE_MAX_DEPTH + 1] = {0}, seen = 0;
    unsigned depth = 0;
    double floor[3];
    if (2 * sure < count)
        return;
    count_by_depth(order, anchor_of(set)->def.leaf_capacity, 0, 0, counts);
    while (depth < OCTREE_MAX_DEPTH && (seen += counts[depth]) < sure - sure / 10)
        depth++;
    for (int i = 0; i < 3; i++) {
        const axis *a = &anchor_of(set)->axes[i];
        floor[i] = ldexp(3 * (a->max / 2 - a->min / 2), -(int)depth); /* 3/2 of a cell */
    }
    set_floor(set, floor);
    set->due = GROWTH_BEFORE_REBUILD * sure;
}
