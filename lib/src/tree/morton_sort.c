/* SPDX-License-Identifier: MIT */
/* morton_sort.c - sorts items by Morton code, by a radix sort from the most significant digit.
 *
 * Problem: sort n items with 63-bit codes. Comparison sorts need n log n unpredictable branches; a radix sort from the
 * least significant digit makes 21 / 3 = 7 passes over all items, each scattered over memory.
 *
 * Idea: start at the most significant digit. One digit is a descent of up to three levels of the tree, and the items
 * with equal digits form a cell. Cells soon fit into the caches. Cells with few items end the recursion: up to 16 items
 * are sorted by insertion sort. The items of a cell that will become a leaf need no order, except that equal codes must
 * be adjacent; a small hash filter usually shows that no codes are equal.
 *
 * With an executor, one parallel pass over all items (count, prefix sums, scatter) divides them into 512 cells, which
 * tasks sort independently. The result does not depend on the number of tasks. Cost: O(n), usually two or three passes.
 */
#include "morton_sort.h"
#include "tasks.h"

#include <string.h>

#define FEW 16   /* a cell of at most this many items is sorted by insertion sort */
#define LEVELS 3 /* the maximum number of tree levels that one pass sorts: 8^3 buckets */

typedef struct sorter {
    const octree *tree; /* the tree; null (like `memory`) if the sort uses no tasks */
    arena *memory;
    size_t unsorted; /* a cell of at most this many items becomes a leaf and stays unsorted */
    bool differ;     /* true: all items are different points, so that equal codes need not be adjacent */
    bool repeated;   /* result of the sort: true if some items may have equal codes */
} sorter;

static void insertion_sort(morton_item *items, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        const morton_item item = items[i];
        size_t at = i;
        for (; at > 0 && items[at - 1].code > item.code; at--)
            items[at] = items[at - 1];
        items[at] = item;
    }
}

static bool has_code(const morton_item *items, size_t count, uint64_t code)
{
    for (size_t i = 0; i < count; i++)
        if (items[i].code == code)
            return true;
    return false;
}

/* Returns whether two of up to MORTON_UNSORTED items have equal codes. Two items are compared only if 12 bits of their
 * multiplicative hashes (Knuth) are equal, which is rare. */
static bool has_equal_codes(const morton_item *items, size_t count)
{
    uint64_t filter[(1u << 12) / 64] = {0};
    for (size_t i = 0; i < count; i++) {
        const unsigned hash = (unsigned)(items[i].code * UINT64_C(0x9e3779b97f4a7c15) >> 52);
        const uint64_t bit = UINT64_C(1) << hash % 64;
        if ((filter[hash / 64] & bit) && has_code(items, i, items[i].code))
            return true;
        filter[hash / 64] |= bit;
    }
    return false;
}

/* End the recursion at a cell that has `left` tree levels below it. Sort the cell's items if they are few, or leave
 * them unsorted if the cell becomes a leaf. */
static void sort_small_cell(sorter *s, morton_item *items, size_t count, unsigned left)
{
    if (left > 0 && count <= s->unsorted && (s->differ || !has_equal_codes(items, count)))
        return;
    s->repeated = true;
    if (left > 0)
        insertion_sort(items, count);
}

/* Returns the number of tree levels to sort in one pass, so that each resulting cell has few items. */
static unsigned choose_levels(const sorter *s, size_t count, unsigned left)
{
    const size_t wanted = s->unsorted > 4 ? s->unsorted : 4;
    unsigned levels = 1;
    while (levels < left && levels < LEVELS && count >> 3 * levels > wanted)
        levels++;
    return levels;
}

/* Distribute the items by one digit of their codes. Before the call, ends[d] is the number of items with digit d. After
 * the call, ends[d] is the end of the range of these items in `to`. */
static void scatter_by_digit(const morton_item *from, morton_item *to, size_t count, unsigned shift, unsigned digits,
                             uint32_t ends[])
{
    uint32_t next = 0;
    for (unsigned digit = 0; digit < digits; digit++) {
        const uint32_t here = ends[digit];
        ends[digit] = next;
        next += here;
    }
    for (size_t i = 0; i < count; i++)
        to[ends[from[i].code >> shift & (digits - 1)]++] = from[i];
}

/* Sort the items of a cell that has `left` tree levels below it. The sorted items are in `items` if in_place is true,
 * otherwise in `other`. */
static void sort_cell(sorter *s, morton_item *items, morton_item *other, size_t count, unsigned left, bool in_place,
                      uint32_t ends[])
{
    if (left == 0 || count <= FEW || count <= s->unsorted) {
        sort_small_cell(s, items, count, left);
        if (!in_place)
            memcpy(other, items, count * sizeof *items);
        return;
    }
    const unsigned levels = choose_levels(s, count, left), digits = 1u << 3 * levels, shift = 3 * (left - levels);
    memset(ends, 0, digits * sizeof *ends);
    for (size_t i = 0; i < count; i++)
        ends[items[i].code >> shift & (digits - 1)]++;
    /* all items have the same digit, so they are all in one cell */
    if (ends[items[0].code >> shift & (digits - 1)] == count) {
        sort_cell(s, items, other, count, left - levels, in_place, ends);
        return;
    }
    scatter_by_digit(items, other, count, shift, digits, ends);
    for (uint32_t digit = 0, start = 0; digit < digits; start = ends[digit++])
        if (ends[digit] > start)
            sort_cell(s, other + start, items + start, ends[digit] - start, left - levels, !in_place, ends + digits);
}

static void sort_on_this_thread(sorter *s, morton_item *items, morton_item *other, size_t count, unsigned left,
                                bool in_place)
{
    /* each level of the recursion uses its own part of the array */
    uint32_t ends[OCTREE_MAX_DEPTH / LEVELS << 3 * LEVELS];
    sort_cell(s, items, other, count, left, in_place, ends);
}

bool morton_sort(morton_item *items, morton_item *spare, size_t count, unsigned depth, size_t unsorted)
{
    sorter s = {.unsorted = unsorted};
    sort_on_this_thread(&s, items, spare, count, OCTREE_MAX_DEPTH - depth, true);
    return s.repeated;
}

/* ---- By tasks ----------------------------------------------------------------------------------------------- */

enum { DIGITS = 1 << 3 * LEVELS };

/* The state of one parallel pass, and the cells into which it divides the items. */
typedef struct pass {
    sorter sorter;
    /* for each task and digit: first the number of items, later the index of the task's next item */
    uint32_t (*counts)[DIGITS];
    morton_item *from, *to;
    size_t count;
    unsigned tasks;
    /* the number of tree levels below the cells into which this pass divides the items */
    unsigned left;
    unsigned shift;                    /* the lowest bit of this pass's digit in a code */
    bool in_place;                     /* true: the sorted items of each cell stay in `to` */
    size_t ends[DIGITS + 1];           /* the items of cell d have the indices ends[d] .. ends[d + 1] - 1 */
    unsigned cells[TASKS_AT_MOST + 1]; /* for each task: the first cell that the task sorts */
    bool repeated[TASKS_AT_MOST];
} pass;

static size_t digit_of(const pass *p, const morton_item *item)
{
    return (size_t)(item->code >> p->shift) & (DIGITS - 1);
}

static void count_digits_in_task(size_t number, void *context)
{
    const pass *p = context;
    uint32_t *counts = p->counts[number];
    memset(counts, 0, sizeof p->counts[number]);
    for (size_t i = find_share_start(p->count, p->tasks, number); i < find_share_start(p->count, p->tasks, number + 1);
         i++)
        counts[digit_of(p, &p->from[i])]++;
}

static void scatter_items_in_task(size_t number, void *context)
{
    const pass *p = context;
    uint32_t *next = p->counts[number];
    for (size_t i = find_share_start(p->count, p->tasks, number); i < find_share_start(p->count, p->tasks, number + 1);
         i++)
        p->to[next[digit_of(p, &p->from[i])]++] = p->from[i];
}

static void convert_counts_to_positions(pass *p)
{
    uint32_t next = 0;
    p->ends[0] = 0;
    for (unsigned digit = 0; digit < DIGITS; digit++) {
        for (unsigned task = 0; task < p->tasks; task++) {
            const uint32_t here = p->counts[task][digit];
            p->counts[task][digit] = next;
            next += here;
        }
        p->ends[digit + 1] = next;
    }
}

/* Returns whether a cell is so large that a parallel pass of its own sorts it. */
static bool is_large_cell(const pass *p, unsigned digit)
{
    const size_t large = p->count / 8;
    return p->left > 0 && p->ends[digit + 1] - p->ends[digit] > large && count_tasks(p->sorter.tree, large) > 1;
}

static void sort_cells_in_task(size_t number, void *context)
{
    pass *p = context;
    uint32_t ends[OCTREE_MAX_DEPTH / LEVELS << 3 * LEVELS];
    sorter s = p->sorter;
    for (unsigned digit = p->cells[number]; digit < p->cells[number + 1]; digit++) {
        const size_t start = p->ends[digit], count = p->ends[digit + 1] - start;
        if (count > 0 && !is_large_cell(p, digit))
            sort_cell(&s, p->to + start, p->from + start, count, p->left, p->in_place, ends);
    }
    p->repeated[number] = s.repeated;
}

static void assign_cells_to_tasks(pass *p)
{
    unsigned digit = 0;
    for (unsigned task = 0; task < p->tasks; task++) {
        p->cells[task] = digit;
        while (digit < DIGITS && p->ends[digit + 1] <= find_share_start(p->count, p->tasks, task + 1))
            digit++;
    }
    p->cells[p->tasks] = DIGITS;
}

/* Sort as sort_cell() does, but by tasks. If there is no memory for the counts, call sort_cell() on this thread. */
static void sort_by_tasks(sorter *s, morton_item *items, morton_item *other, size_t count, unsigned left, bool in_place)
{
    pass p = {.sorter = *s, .from = items, .to = other, .count = count, .left = left - LEVELS, .in_place = !in_place};
    p.tasks = count_tasks(s->tree, count);
    p.shift = 3 * p.left;
    p.counts = arena_allocate(s->memory, p.tasks * sizeof *p.counts);
    if (!p.counts) {
        sort_on_this_thread(s, items, other, count, left, in_place);
        return;
    }
    run_tasks(s->tree, count_digits_in_task, p.tasks, &p);
    convert_counts_to_positions(&p);
    run_tasks(s->tree, scatter_items_in_task, p.tasks, &p);
    arena_free(s->memory, p.counts, p.tasks * sizeof *p.counts);
    assign_cells_to_tasks(&p);
    run_tasks(s->tree, sort_cells_in_task, p.tasks, &p);
    for (unsigned task = 0; task < p.tasks; task++)
        s->repeated |= p.repeated[task];
    for (unsigned digit = 0; digit < DIGITS; digit++)
        if (is_large_cell(&p, digit))
            sort_by_tasks(s, other + p.ends[digit], items + p.ends[digit], p.ends[digit + 1] - p.ends[digit], p.left,
                          p.in_place);
}

bool morton_sort_by_tasks(const octree *tree, arena *memory, morton_item *items, morton_item *spare, size_t count,
                          size_t unsorted, bool differ)
{
    sorter s = {.tree = tree, .memory = memory, .unsorted = unsorted, .differ = differ};
    (count_tasks(tree, count) == 1 ? sort_on_this_thread : sort_by_tasks)(&s, items, spare, count, OCTREE_MAX_DEPTH,
                                                                          true);
    return s.repeated;
}
