/* SPDX-License-Identifier: MIT */
/* order.c - many bodies in the order of the cells of a fine grid, and the floor of their set.
 *
 * A radix sort by the Morton codes of a fine grid brings neighbours together, in O(n), in crowds too. The order also
 * tells how deep the leaves will be, before there is a tree: a leaf is the largest cell that holds at most as many
 * bodies as the capacity.
 *
 * The floor is the size up to which bodies share one level (level.c). A smaller floor adds levels, each of which costs
 * a descent; a larger one makes the boxes of nodes too large. The floor is 3/2 of the cell of a leaf, at a depth that
 * nine of ten bodies' leaves do not exceed, so that sparse regions do not slow down dense ones. Measured in
 * instructions, with 1e5 uniform bodies: beside a floor of 3/8 of a cell, sizes over three decades are searched in 15
 * to 27 % fewer, and streets in 10 to 17 %. If all bodies are small, but one in 20 has 1.3 cells, a search takes 1.7
 * times as many; with a floor of 5/2 of a cell, decades up to such sizes would take 1.2 times as many.
 */
#include "order.h"
#include "../query/search.h"

/* The depth of the grid. Crowds are sorted finely, but in small sets less so, because each digit of the radix sort
 * takes time. */
enum { DEPTH = 7, DEPTH_OF_MANY = 10, MANY = 1 << 18 };

/* A digit of the radix sort. Two have the cells of a grid of depth 7, three those of depth 10, and no_cell(). */
enum { DIGIT_BITS = 11, DIGIT_VALUES = 1 << DIGIT_BITS };

/* Morton codes are computed for so many bodies at once. */
enum { CODES_AT_ONCE = 256 };

/* Returns the number of a cell that bodies outside the world have. They will be refused. */
static uint32_t no_cell(const row_order *order)
{
    return UINT32_C(1) << 3 * order->depth;
}

/* Returns the cell of a position that may be on a plane of the grid. The cell on the other side would be as good. */
static uint32_t guess_cell(const row_order *order, const axis axes[3], const double position[3])
{
    uint32_t keys[3];
    for (int i = 0; i < 3; i++) {
        if (!(position[i] >= axes[i].min && position[i] <= axes[i].max))
            return no_cell(order);
        const double key = plane_guess_key(&axes[i], position[i]);
        keys[i] = key < PLANE_GRID ? (uint32_t)key : PLANE_GRID - 1;
    }
    return (uint32_t)(morton_interleave(keys) >> 3 * (OCTREE_MAX_DEPTH - order->depth));
}

static void compute_keys(const row_order *order, const axis axes[3], const octree_body *added, uint64_t *keys)
{
    for (size_t first = 0; first < order->count; first += CODES_AT_ONCE) {
        uint64_t codes[CODES_AT_ONCE];
        const size_t left = order->count - first, some = left < CODES_AT_ONCE ? left : CODES_AT_ONCE;
        compute_morton_codes(axes, added[first].position, sizeof *added / sizeof(double), some, codes);
        for (size_t i = 0; i < some; i++) {
            const uint64_t cell = codes[i] != MORTON_UNSURE ? codes[i] >> 3 * (OCTREE_MAX_DEPTH - order->depth)
                                                            : guess_cell(order, axes, added[first + i].position);
            keys[first + i] = cell << 32 | (first + i);
        }
    }
}

/* Sort by a digit of the cells, from one array into another. Keys with the same digit keep their order. */
static void sort_by_digit(const uint64_t *from, uint64_t *to, size_t count, unsigned digit)
{
    uint32_t ends[DIGIT_VALUES + 1] = {0};
    const unsigned shift = 32 + digit * DIGIT_BITS;
    for (size_t i = 0; i < count; i++)
        ends[(from[i] >> shift) % DIGIT_VALUES + 1]++;
    for (size_t i = 1; i < DIGIT_VALUES; i++)
        ends[i] += ends[i - 1];
    for (size_t i = 0; i < count; i++)
        to[ends[(from[i] >> shift) % DIGIT_VALUES]++] = from[i];
}

/* The keys, and room to sort them. */
static size_t bytes_of_order(const row_order *order)
{
    return 2 * order->count * sizeof *order->keys;
}

row_order make_order(octree_bodies *set, const octree_body *added, size_t count)
{
    row_order order = {.count = count, .depth = count < MANY ? DEPTH : DEPTH_OF_MANY};
    order.keys = arena_allocate(&set->memory, bytes_of_order(&order));
    if (!order.keys)
        return order;
    const unsigned digits = (3 * order.depth + DIGIT_BITS) / DIGIT_BITS;
    uint64_t *arrays[2] = {order.keys, order.keys + count}; /* the last digit is sorted into the first array */
    compute_keys(&order, anchor_of(set)->axes, added, arrays[digits % 2]);
    for (unsigned digit = 0; digit < digits; digit++)
        sort_by_digit(arrays[(digits - digit) % 2], arrays[(digits - digit - 1) % 2], count, digit);
    return order;
}

void free_order(octree_bodies *set, const row_order *order)
{
    arena_free(&set->memory, order->keys, bytes_of_order(order));
}

bool has_sparse_cells(const row_order *order)
{
    enum { FEW = 32 };
    bool sparse = order->keys != NULL;
    for (size_t i = FEW; sparse && i < order->count; i++)
        sparse = cell_in_order(order, i) != cell_in_order(order, i - FEW);
    return sparse;
}

/* ---- The floor ---------------------------------------------------------------------------------------------- */

/* Returns the index of the first of the keys begin .. end - 1 whose cell is not below a cell; `end` if there is none.
 */
static size_t find_cell(const row_order *order, size_t begin, size_t end, uint32_t cell)
{
    while (begin < end) {
        const size_t middle = begin + (end - begin) / 2;
        if (cell_in_order(order, middle) < cell)
            begin = middle + 1;
        else
            end = middle;
    }
    return end;
}

/* Add the number of bodies in a cell, those with the keys begin .. end - 1, to the depths that their leaves will have
 * in one tree. Below the grid, each level is assumed to divide the bodies by 4, as on a surface. */
static void count_by_depth(const row_order *order, const octree_def *def, unsigned depth, uint32_t cell, size_t begin,
                           size_t end, size_t counts[OCTREE_MAX_DEPTH + 1])
{
    const size_t count = end - begin;
    if (count > def->leaf_capacity && depth < order->depth && depth < def->max_depth) {
        for (uint32_t child = cell << 3; child < (cell + 1) << 3; child++) {
            const size_t next = find_cell(order, begin, end, (child + 1) << 3 * (order->depth - depth - 1));
            count_by_depth(order, def, depth + 1, child, begin, next, counts);
            begin = next;
        }
        return;
    }
    for (size_t left = count; left > def->leaf_capacity && depth < def->max_depth; left /= 4)
        depth++;
    counts[depth] += count;
}

void choose_floor(octree_bodies *set, const row_order *order)
{
    const size_t count = find_cell(order, 0, order->count, no_cell(order));
    size_t counts[OCTREE_MAX_DEPTH + 1] = {0}, seen = 0;
    unsigned depth = 0;
    double floor[3];
    if (count == 0)
        return;
    count_by_depth(order, &anchor_of(set)->def, 0, 0, 0, count, counts);
    while (depth < OCTREE_MAX_DEPTH && (seen += counts[depth]) < count - count / 10)
        depth++;
    for (int i = 0; i < 3; i++) {
        const axis *a = &anchor_of(set)->axes[i];
        floor[i] = ldexp(3 * (a->max / 2 - a->min / 2), -(int)depth); /* 3/2 of a cell */
    }
    set_floor(set, floor);
    set->due = GROWTH_BEFORE_REBUILD * count;
}
